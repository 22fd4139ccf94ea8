/* What the core asks of a board: twelve functions. A port is one file that has them, and a `main`
 * that calls board_start() once, board_poll() for ever and board_tick() every millisecond from a
 * timer of its own, at a higher priority than whatever else runs. */
#ifndef PORT_H
#define PORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What stands between the board and its motors, as it is now. */
typedef struct {
    float hottest; /* of motors and amplifiers [degree C] */
    float supply;  /* of the motors, behind the switch [V] */
    bool ready;    /* no amplifier reports a fault */
} health_t;

/* Number of this power cycle: another one after each start. */
uint32_t port_boot(void);

/* Time since power-up [us], modulo 2^32. */
uint32_t port_time(void);

/* Take the next byte that has come; false: there is none. */
bool port_read(uint8_t *byte);

/* Send bytes; returns at once, and drops what does not fit. */
void port_write(const uint8_t *bytes, size_t count);

/* The encoder's counter, 16 bits; counts grow counter-clockwise seen from above. */
uint16_t port_encoder(unsigned joint);

/* Whether the index has passed since the last call, and the counter there. */
bool port_index(unsigned joint, uint16_t *latched);

health_t port_health(void);

/* Let a motor's amplifier drive this current [A]; a positive one turns the joint counter-clockwise,
 * or draws the cable. */
void port_current(unsigned motor, float current);

/* Let a winch reel in at this speed [m/s] and not give way. Only of boards with cables. */
void port_reel(unsigned winch, float speed);

/* Tension [N] of a cable, and what its winch has reeled in [m]. Only of boards with cables. */
void port_cable(unsigned winch, float *tension, float *reeled);

/* Switch the amplifiers' enable line; off is what it is at power-up. */
void port_enable(bool on);

/* Keep board_tick() from running, or let it run again. */
void port_lock(bool on);

#endif
