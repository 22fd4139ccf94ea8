/* The board's program: what it answers, and when its motors turn (docs/protocol.md). */
#ifndef BOARD_H
#define BOARD_H

#include "device.h"
#include "encoder.h"
#include "states.h"

#ifndef SERIAL_NUMBER
#define SERIAL_NUMBER "A0001" /* of this board: make firmware SERIAL=... */
#endif

enum {
    JOINTS = 2,
    CHANNELS = (CABLES != 0) ? 4 : 2,
    VERSION = (CABLES != 0) ? 2 : 1,
    FIRMWARE_MAJOR = 1,
    FIRMWARE_MINOR = 0,
    TICK_US = 1000,
    TRIP_US = ((int)WATCHDOG_MS * 1000) - (2 * TICK_US), /* two ticks before the time is over */
    LASTING = 3,                        /* ticks that heat or a low supply last before they count */
    FURTHEST = COUNTS_PER_TURN / 8,     /* counts between two readings: an eighth of a turn in 1 ms */
    INDEX_SLACK = 4                     /* counts: an edge of either channel, both ways round */
};

typedef enum {
    NONE = 0,
    TORQUE_NOT_FINITE = 1,
    HOME_REFUSED = 2,
    ENCODER = 3,
    AMPLIFIER = 4,
    SUPPLY_OFF = 5,
    TOO_HOT = 6
} fault_t;

typedef struct {
    state_t state;
    fault_t error;
    bool homed;
    bool tripped;
    bool limited; /* the newest command asked for more than the largest */
    bool holds;   /* the channels are speeds of reeling in */
    uint32_t boot;
    uint32_t obeyed;          /* time of the newest command with enable [us] */
    float channels[CHANNELS]; /* joint torques [N m]; tensions [N] or speeds [m/s] */
    encoder_t encoders[JOINTS];
    fault_t ailing; /* heat or supply, as at the last tick */
    unsigned ailed; /* ticks for which it has been so */
} board_t;

/* Start: motors off, not greeted, not homed. */
void board_start(void);

/* Take the bytes that have come, obey and answer: from the main loop. */
void board_poll(void);

/* Watch over commands, encoders, supply and heat: every millisecond from a timer. */
void board_tick(void);

/* For tests and simulated plants. */
const board_t *board_now(void);

#endif
