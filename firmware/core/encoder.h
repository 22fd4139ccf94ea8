/* One encoder: a counter of 16 bits made 32 bits wide, and held against its index. */
#ifndef ENCODER_H
#define ENCODER_H

#include <stdbool.h>
#include <stdint.h>

typedef struct {
    uint16_t counter;  /* as it was read last */
    uint32_t position; /* counts since power-up, modulo 2^32 */
    uint32_t zero;     /* position at the home angle */
    uint32_t index;    /* position of the first index, whose distance to each other is whole periods */
    bool indexed;
} encoder_t;

void encoder_start(encoder_t *encoder, uint16_t counter);

/* Take a reading; false if it is further from the last than `furthest` counts. */
bool encoder_follow(encoder_t *encoder, uint16_t counter, int32_t furthest);

/* Take the counter at the index; false if counts were lost or won since the first: the distance is
 * no whole number of periods, by more than `slack` counts. */
bool encoder_index(encoder_t *encoder, uint16_t latched, int32_t period, int32_t slack);

/* The joint stands at its home angle: count from here. */
void encoder_home(encoder_t *encoder);

/* Counts since the home angle. */
int32_t encoder_counts(const encoder_t *encoder);

#endif
