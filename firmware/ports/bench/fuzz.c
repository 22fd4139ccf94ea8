/* Any sequence of bytes, times, encoder readings and health: what must hold, holds after each.
 *
 * `make fuzz` runs it under libFuzzer (clang); built with -DSEEDS=n it is a program of its own that
 * makes n seeded scripts, under gcc's sanitizers. */
#include <stdlib.h>

#include "board.h"
#include "frame.h"
#include "port.h"

extern uint32_t bench_time;
extern size_t bench_in_count, bench_in_taken, bench_out_count;
extern uint16_t bench_encoder[JOINTS], bench_latched[JOINTS];
extern bool bench_index[JOINTS], bench_enabled;
extern health_t bench_health;
extern float bench_current[CHANNELS], bench_reel[CHANNELS];
extern int bench_locks;
void bench_feed(const uint8_t *bytes, size_t count);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void must(bool holds)
{
    if (!holds) {
        abort();
    }
}

static void look(void)
{
    const board_t *board = board_now();
    const bool fresh = (bench_time - board->obeyed) <= (WATCHDOG_MS * 1000U);

    must(bench_locks == 0);
    must(board->state < STATES);
    must(bench_enabled == (board->state == ENABLED));
    must((board->state != ENABLED) || (fresh && (board->error == NONE)));
    must((board->state != FAULT) || (board->error >= ENCODER));
    must((board->error == NONE) || (board->state != IDLE));
    for (int k = 0; k < CHANNELS; k++) {
        must(bench_enabled || ((bench_current[k] == 0.0f) && (bench_reel[k] == 0.0f)));
        must((bench_current[k] >= -LARGEST_CURRENT) && (bench_current[k] <= LARGEST_CURRENT));
    }
}

/* A script: a byte says what follows, the next how much of it. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const uint8_t kinds[] = {0x01, (CABLES != 0) ? 0x04 : 0x02, 0x03};

    bench_in_count = bench_in_taken = bench_out_count = 0U;
    bench_health = (health_t){25.0f, 24.0f, true};
    board_start();
    for (size_t k = 0U; k + 2U < size;) {
        const uint8_t what = data[k], much = data[k + 1U];
        uint8_t message[FRAME_BUFFER] = {0}, frame[FRAME_BYTES];
        size_t length = 0U;
        k += 2U;
        if (what < 32U) { /* bytes as they are */
            for (; (length < much) && (length < 60U) && (k < size); k++) {
                frame[length++] = data[k];
            }
            bench_feed(frame, length);
        } else if (what < 160U) { /* a message with its checksum */
            const size_t lengths[] = {2U, 4U + (4U * CHANNELS), 5U};
            const size_t wanted = (what < 150U) ? lengths[what % 3U] : 1U + (much % 60U);
            message[length++] = (what < 155U) ? kinds[what % 3U] : much;
            for (; (length < wanted) && (k < size); k++) {
                message[length++] = data[k];
            }
            if (message[0] == kinds[0]) {
                message[1] &= 3U; /* few versions are greeted in */
            }
            bench_feed(frame, frame_encode(message, (length < wanted) ? wanted : length, frame));
        } else if (what < 220U) {
            for (unsigned t = 0U; t < (much % 24U); t++) {
                bench_time += 1000U;
                board_tick();
                look();
            }
        } else if (what < 240U) {
            bench_encoder[what % 2U] = (uint16_t)(bench_encoder[what % 2U] + much);
            bench_latched[what % 2U] = bench_encoder[what % 2U];
            bench_index[what % 2U] = much > 200U;
        } else {
            bench_health = (health_t){(float)much, (float)(what - 230U), what != 255U};
        }
        look();
    }
    return 0;
}

#ifdef SEEDS
int main(void)
{
    uint64_t x = 88172645463325252U;
    uint8_t script[256];
    for (unsigned n = 0U; n < SEEDS; n++) {
        for (size_t k = 0U; k < sizeof script; k++) {
            x ^= x << 13;
            x ^= x >> 7;
            x ^= x << 17;
            script[k] = (uint8_t)(x >> 33);
        }
        LLVMFuzzerTestOneInput(script, sizeof script);
    }
    return 0;
}
#endif
