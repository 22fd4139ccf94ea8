#include "encoder.h"

/* The signed distance of two counters, the shorter way round. */
static int32_t distance(uint16_t to, uint16_t from)
{
    return (int16_t)(uint16_t)(to - from);
}

void encoder_start(encoder_t *encoder, uint16_t counter)
{
    const encoder_t fresh = {.counter = counter};
    *encoder = fresh;
}

bool encoder_follow(encoder_t *encoder, uint16_t counter, int32_t furthest)
{
    const int32_t way = distance(counter, encoder->counter);
    encoder->counter = counter;
    encoder->position += (uint32_t)way;
    return (way <= furthest) && (way >= -furthest);
}

bool encoder_index(encoder_t *encoder, uint16_t latched, int32_t period, int32_t slack)
{
    const uint32_t here = encoder->position + (uint32_t)distance(latched, encoder->counter);
    int32_t off = 0;

    if (encoder->indexed) {
        const uint32_t since = here - encoder->index;
        off = (int32_t)since;
        off %= period;
    } else {
        encoder->indexed = true;
        encoder->index = here;
    }
    if (off < 0) {
        off = -off;
    }
    return (off <= slack) || (off >= (period - slack));
}

void encoder_home(encoder_t *encoder)
{
    encoder->zero = encoder->position;
}

int32_t encoder_counts(const encoder_t *encoder)
{
    const uint32_t since = encoder->position - encoder->zero;
    return (int32_t)since;
}
