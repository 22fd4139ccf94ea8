/* A port for tests: a shared library whose variables are the outside world. */
#include "board.h"
#include "port.h"

uint32_t bench_boot = 1U;
uint32_t bench_time;
uint8_t bench_in[4096];
size_t bench_in_count;
size_t bench_in_taken;
uint8_t bench_out[65536];
size_t bench_out_count;
uint16_t bench_encoder[JOINTS];
uint16_t bench_latched[JOINTS];
bool bench_index[JOINTS];
health_t bench_health = {25.0f, 24.0f, true};
float bench_current[CHANNELS];
float bench_reel[CHANNELS];
float bench_tension[CHANNELS];
float bench_reeled[CHANNELS];
bool bench_enabled;
int bench_locks;

uint32_t port_boot(void) { return bench_boot; }
uint32_t port_time(void) { return bench_time; }
uint16_t port_encoder(unsigned joint) { return bench_encoder[joint]; }
health_t port_health(void) { return bench_health; }
void port_enable(bool on) { bench_enabled = on; }
void port_lock(bool on) { bench_locks += on ? 1 : -1; }

bool port_read(uint8_t *byte)
{
    if (bench_in_taken >= bench_in_count) {
        bench_in_taken = bench_in_count = 0U;
        return false;
    }
    *byte = bench_in[bench_in_taken++];
    return true;
}

void port_write(const uint8_t *bytes, size_t count)
{
    for (size_t k = 0U; (k < count) && (bench_out_count < sizeof bench_out); k++) {
        bench_out[bench_out_count++] = bytes[k];
    }
}

bool port_index(unsigned joint, uint16_t *latched)
{
    const bool passed = bench_index[joint];
    bench_index[joint] = false;
    *latched = bench_latched[joint];
    return passed;
}

void port_current(unsigned motor, float current)
{
    bench_current[motor] = current;
    bench_reel[motor] = 0.0f;
}

void port_reel(unsigned winch, float speed)
{
    bench_reel[winch] = speed;
    bench_current[winch] = 0.0f;
}

void port_cable(unsigned winch, float *tension, float *reeled)
{
    *tension = bench_tension[winch];
    *reeled = bench_reeled[winch];
}

/* Of what ctypes and a fuzzer need: one call each. */
void bench_feed(const uint8_t *bytes, size_t count)
{
    for (size_t k = 0U; (k < count) && (bench_in_count < sizeof bench_in); k++) {
        bench_in[bench_in_count++] = bytes[k];
    }
    board_poll();
}

int bench_state(void) { return (int)board_now()->state; }
int bench_error(void) { return (int)board_now()->error; }
