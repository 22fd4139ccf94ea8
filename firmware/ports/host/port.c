/* A board on this computer: the core behind a pseudo-terminal, with two free arms or four winches.
 *
 *     acus-board [LINK]        prints the terminal's path, or makes a link to it
 *
 * Lines on the standard input: hot C, supply V, ready 0|1, turn LEFT RIGHT (degrees), slip LEFT
 * (counts that the left encoder loses), hold D K (a hand that gives way slowly, N m s/rad at
 * each joint, and pulls back to where they are now, N m/rad; 0 lets go), freeze 0|1 (the program
 * hangs, its timer goes on), reset, torques (prints what the motors give), quit. Each is answered
 * `ok`. */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <pthread.h>
#include <pty.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "board.h"
#include "port.h"

#define INERTIA 2e-3 /* of an arm with its rotor [kg m^2] */
#define VISCOUS 4e-3 /* [N m s/rad] */
#define TURN 6.28318530717958647692

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static double born; /* time of the power-up [s] */
static int terminal;
static uint8_t incoming[512];
static size_t came, taken;
static health_t health = {25.0f, 24.0f, true};
static double angle[JOINTS], speed[JOINTS]; /* of the joints [rad], [rad/s] */
static double damped, pulled;               /* by a hand [N m s/rad], [N m/rad] */
static double wanted[JOINTS];               /* where it pulls to [rad] */
static long slipped[JOINTS], seen[JOINTS];  /* counts lost; count at the index looked for last */
static double current[CHANNELS], reel[CHANNELS]; /* [A], [m/s] */
#if CABLES
static double reeled[CHANNELS]; /* [m] */
#endif
static uint32_t power_cycle;

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + (1e-9 * (double)t.tv_nsec);
}

static long count(unsigned joint)
{
    return lround(floor((angle[joint] / TURN * COUNTS_PER_TURN) + 0.5));
}

uint32_t port_boot(void) { return power_cycle; }
uint32_t port_time(void) { return (uint32_t)(uint64_t)((now() - born) * 1e6); }
health_t port_health(void) { return health; }
void port_enable(bool on) { (void)on; }
uint16_t port_encoder(unsigned joint) { return (uint16_t)(count(joint) - slipped[joint]); }

bool port_index(unsigned joint, uint16_t *latched)
{
    const double period = (INDEX_PERIOD > 0) ? INDEX_PERIOD : 1;
    const long from = seen[joint];
    const long to = count(joint);
    const long at = lround(floor((double)((to > from) ? to : from) / period) * period);

    seen[joint] = to;
    *latched = (uint16_t)(at - slipped[joint]);
    return (at > from) != (at > to);
}

bool port_read(uint8_t *byte)
{
    if (taken >= came) {
        const ssize_t got = read(terminal, incoming, sizeof incoming);
        taken = 0U;
        came = (got > 0) ? (size_t)got : 0U;
    }
    if (came == 0U) {
        return false;
    }
    *byte = incoming[taken++];
    return true;
}

void port_write(const uint8_t *bytes, size_t size)
{
    if (write(terminal, bytes, size) < 0) {
        errno = 0; /* nobody reads: the answer is lost */
    }
}

void port_current(unsigned motor, float amperes)
{
    current[motor] = (double)amperes;
    reel[motor] = 0.0;
}

void port_reel(unsigned winch, float metres)
{
    reel[winch] = (double)metres;
    current[winch] = 0.0;
}

void port_cable(unsigned winch, float *tension, float *length)
{
#if CABLES
    *tension = (float)(current[winch] * (double)NEWTON_PER_AMPERE);
    *length = (float)reeled[winch];
#else
    (void)winch;
    *tension = *length = 0.0f;
#endif
}

void port_lock(bool on)
{
    if (on) {
        pthread_mutex_lock(&lock);
    } else {
        pthread_mutex_unlock(&lock);
    }
}

/* Move arms and winches for a while. */
static void move(double seconds)
{
    port_lock(true);
#if CABLES
    for (unsigned k = 0U; k < (unsigned)CHANNELS; k++) {
        reeled[k] += reel[k] * seconds;
    }
#else
    for (unsigned k = 0U; k < (unsigned)JOINTS; k++) {
        const double motor = current[k] * (double)(GEAR * TORQUE_CONSTANT);
        const double torque = motor + (pulled * (wanted[k] - angle[k]));
        const double rate = (VISCOUS + damped) / INERTIA;
        speed[k] = (speed[k] + (torque / INERTIA * seconds)) / (1.0 + (rate * seconds));
        angle[k] += speed[k] * seconds;
    }
#endif
    port_lock(false);
}

/* The timer: its thread goes on whatever the program does. */
static void *timer(void *nothing)
{
    double last = now();
    struct timespec next;
    clock_gettime(CLOCK_MONOTONIC, &next);
    for (;;) {
        next.tv_nsec += 1000L * TICK_US;
        if (next.tv_nsec >= 1000000000L) {
            next.tv_nsec -= 1000000000L;
            next.tv_sec++;
        }
        clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &next, NULL);
        const double moment = now();
        move(moment - last);
        last = moment;
        board_tick();
    }
    return nothing;
}

static void start(void)
{
    port_lock(true);
    born = now();
    power_cycle++;
    board_start();
    port_lock(false);
}

/* Turn the arms by a hand: over a fifth of a second. */
static void turn(double left, double right)
{
    for (int k = 0; k < 200; k++) {
        const struct timespec step = {0, 1000000L};
        port_lock(true);
        angle[0] += left / 360.0 * TURN / 200.0;
        angle[1] += right / 360.0 * TURN / 200.0;
        speed[0] = speed[1] = 0.0;
        port_lock(false);
        nanosleep(&step, NULL);
        board_poll();
    }
}

/* Obey a line; false: it was `quit`. */
static bool order(const char *line, bool *frozen)
{
    double a = 0.0, b = 0.0;
    char word[16] = "";
    (void)sscanf(line, "%15s %lf %lf", word, &a, &b);
    if (strcmp(word, "quit") == 0) {
        return false;
    } else if (strcmp(word, "hot") == 0) {
        health.hottest = (float)a;
    } else if (strcmp(word, "supply") == 0) {
        health.supply = (float)a;
    } else if (strcmp(word, "ready") == 0) {
        health.ready = a != 0.0;
    } else if (strcmp(word, "turn") == 0) {
        turn(a, b);
    } else if (strcmp(word, "slip") == 0) {
        slipped[0] += lround(a);
    } else if (strcmp(word, "hold") == 0) {
        port_lock(true);
        damped = a;
        pulled = b;
        memcpy(wanted, angle, sizeof wanted);
        port_lock(false);
    } else if (strcmp(word, "freeze") == 0) {
        *frozen = a != 0.0;
    } else if (strcmp(word, "reset") == 0) {
        start();
    } else if (strcmp(word, "torques") == 0) {
        for (unsigned k = 0U; k < (unsigned)CHANNELS; k++) {
            printf("%.6g ", current[k]);
        }
    } else {
        printf("not understood: ");
    }
    puts("ok");
    return true;
}

int main(int count_of_words, char **words)
{
    char path[64], line[128];
    int other = -1;
    bool frozen = false;
    pthread_t thread;
    struct termios raw;

    power_cycle = (uint32_t)getpid();
    if ((openpty(&terminal, &other, path, NULL, NULL) != 0) || (tcgetattr(other, &raw) != 0) ||
        (fcntl(terminal, F_SETFL, O_NONBLOCK) != 0)) {
        perror("acus-board: no pseudo-terminal");
        return 1;
    }
    cfmakeraw(&raw);
    tcsetattr(other, TCSANOW, &raw);
    if ((count_of_words > 1) && (symlink(path, words[1]) != 0)) {
        perror(words[1]);
        return 1;
    }
    setvbuf(stdout, NULL, _IOLBF, 0U);
    start();
    pthread_create(&thread, NULL, timer, NULL);
    puts((count_of_words > 1) ? words[1] : path);
    for (;;) {
        struct pollfd ways[2] = {{terminal, POLLIN, 0}, {STDIN_FILENO, POLLIN, 0}};
        poll(frozen ? &ways[1] : ways, frozen ? 1U : 2U, -1);
        if (!frozen) {
            board_poll();
        }
        if (((ways[1].revents) != 0) &&
            ((fgets(line, sizeof line, stdin) == NULL) || !order(line, &frozen))) {
            break;
        }
    }
    if (count_of_words > 1) {
        unlink(words[1]);
    }
    return 0;
}
