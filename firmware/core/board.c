#include "board.h"

#include "frame.h"
#include "port.h"

/* Messages of docs/protocol.md; lengths without the CRC. */
enum {
    HELLO = 0x01, HELLO_BYTES = 2,
    COMMAND = (CABLES != 0) ? 0x04 : 0x02, COMMAND_BYTES = 4 + (4 * CHANNELS),
    HOME = 0x03, HOME_BYTES = 5,
    INFO = 0x81, INFO_BYTES = 50, TEXT_BYTES = 16,
    STATE = (CABLES != 0) ? 0x84 : 0x82, STATE_BYTES = 17
};

enum { WITH_ENABLE = 1U, WITH_HOLD = 2U };
enum { IS_ENABLED = 1U, IS_HOMED = 2U, HAS_TRIPPED = 4U, IS_GREETED = 16U, IS_LIMITED = 32U };
enum { EMULATED = 2U, SAYS_LIMITED = 4U };

/* The largest torque [N m] or tension [N] is what the profile allows and the amplifiers can give. */
#if CABLES
#define AMPLIFIERS_GIVE (LARGEST_CURRENT * NEWTON_PER_AMPERE)
static const float LARGEST = (TENSION < AMPLIFIERS_GIVE) ? TENSION : AMPLIFIERS_GIVE;
#else
#define AMPLIFIERS_GIVE (LARGEST_CURRENT * GEAR * TORQUE_CONSTANT)
static const float LARGEST = (JOINT_TORQUE < AMPLIFIERS_GIVE) ? JOINT_TORQUE : AMPLIFIERS_GIVE;
#endif

static board_t board;
static receiver_t receiver;
static uint8_t message[FRAME_BUFFER]; /* that came, then the answer to it */
static size_t filled;                 /* bytes of the answer */

/* ---- motors -------------------------------------------------------------------------------- */

static void drive(void)
{
    const bool on = board.state == ENABLED;

    for (unsigned k = 0U; k < (unsigned)CHANNELS; k++) {
        const float asked = on ? board.channels[k] : 0.0f;
#if CABLES
        if (on && board.holds) {
            port_reel(k, asked);
        } else {
            port_current(k, asked / NEWTON_PER_AMPERE);
        }
#else
        port_current(k, asked / (GEAR * TORQUE_CONSTANT));
#endif
    }
    port_enable(on);
}

static void happens(event_t event)
{
    board.state = state_after(board.state, event);
    drive();
}

/* Report an error; a smaller number never hides a greater one. */
static void fails(event_t event, fault_t error)
{
    if (error > board.error) {
        board.error = error;
    }
    happens(event);
}

static void ends(fault_t error)
{
    if (board.error == error) {
        board.error = NONE;
    }
}

/* ---- what is watched ----------------------------------------------------------------------- */

static void follow_encoders(void)
{
    for (unsigned k = 0U; k < (unsigned)JOINTS; k++) {
        bool sound = encoder_follow(&board.encoders[k], port_encoder(k), FURTHEST);
        uint16_t latched = 0U;
        if ((INDEX_PERIOD > 0) && port_index(k, &latched)) {
            sound = encoder_index(&board.encoders[k], latched, INDEX_PERIOD, INDEX_SLACK) && sound;
        }
        if (!sound) {
            fails(BROKEN, ENCODER);
        }
    }
}

/* What is wrong with the supply or with heat; NaN is wrong too. */
static fault_t ailment(const health_t *health)
{
    fault_t found = NONE;
    if (!(health->supply >= LEAST_SUPPLY)) {
        found = SUPPLY_OFF;
    }
    if (!(health->hottest <= HOTTEST)) {
        found = TOO_HOT;
    }
    return found;
}

static void look_after_health(void)
{
    const health_t health = port_health();
    const fault_t found = ailment(&health);

    board.ailed = (found == board.ailing) ? (board.ailed + 1U) : 1U;
    board.ailing = found;
    if (found == NONE) {
        board.ailed = 0U;
    }
    if (board.ailed >= (unsigned)LASTING) {
        board.ailed = LASTING;
        fails(BROKEN, found);
    }
    if (!health.ready) {
        fails(BROKEN, AMPLIFIER);
    }
}

/* The watchdog: the tick looks in time, a command that comes before a late tick looks too. */
static void look_at_the_clock(void)
{
    if ((board.state == ENABLED) && ((port_time() - board.obeyed) >= (uint32_t)TRIP_US)) {
        board.tripped = true;
        happens(LATE);
    }
}

void board_tick(void)
{
    port_lock(true);
    follow_encoders();
    look_after_health();
    look_at_the_clock();
    port_lock(false);
}

/* ---- numbers of a message, low byte first -------------------------------------------------- */

typedef union { /* an IEEE 754 single and its bits */
    float value;
    uint32_t bits;
} single_t;

static uint32_t get(size_t at, size_t bytes)
{
    uint32_t value = 0U;
    for (size_t k = at + bytes; k > at; k--) {
        value = (value << 8) | message[k - 1U];
    }
    return value;
}

static void add(uint32_t value, size_t bytes)
{
    uint32_t rest = value;
    for (size_t k = 0U; k < bytes; k++) {
        message[filled] = (uint8_t)(rest & 0xFFU);
        filled++;
        rest >>= 8;
    }
}

static void add_single(float value)
{
    const single_t single = {.value = value};
    add(single.bits, 4U);
}

static void add_text(const char *text)
{
    bool ended = false;
    for (size_t k = 0U; k < (size_t)TEXT_BYTES; k++) {
        ended = ended || (text[k] == '\0');
        add(ended ? 0U : (uint8_t)text[k], 1U);
    }
}

static void answer(void)
{
    uint8_t frame[FRAME_BYTES];
    port_write(frame, frame_encode(message, filled, frame));
}

/* ---- messages ------------------------------------------------------------------------------ */

static void hello(void)
{
    const bool ours = message[1] == (uint8_t)VERSION;

    port_lock(true);
    board.error = NONE;
    happens(ours ? GREETED : ESTRANGED);
    look_after_health(); /* greeting does not cool a motor */
    port_lock(false);

    filled = 0U;
    add(INFO, 1U);
    add(VERSION, 1U);
    add(FIRMWARE_MAJOR, 1U);
    add(FIRMWARE_MINOR, 1U);
    add(board.boot, 4U);
    add(COUNTS_PER_TURN, 4U);
    add_single(LARGEST);
#ifdef BOARD_IS_A_PROGRAM
    add(EMULATED | SAYS_LIMITED, 1U);
#else
    add(SAYS_LIMITED, 1U);
#endif
    add(WATCHDOG_MS, 1U);
    add_text(SERIAL_NUMBER);
    add_text(DEVICE_PROFILE);
    answer();
}

/* Read the channels of a command; false if one is not finite. */
static bool read_channels(float channels[CHANNELS])
{
    bool finite = true;
    for (size_t k = 0U; k < (size_t)CHANNELS; k++) {
        const single_t single = {.bits = get(4U + (4U * k), 4U)};
        finite = finite && ((single.bits & 0x7F800000U) != 0x7F800000U);
        channels[k] = single.value;
    }
    return finite;
}

/* Limit what is asked; returns whether it was too much. */
static bool limit(float channels[CHANNELS])
{
#if CABLES
    const float low = board.holds ? -FASTEST : 0.0f;
    const float high = board.holds ? FASTEST : LARGEST;
    bool limited = false;
    for (size_t k = 0U; k < (size_t)CHANNELS; k++) {
        const float asked = channels[k];
        channels[k] = (asked < low) ? low : ((asked > high) ? high : asked);
        limited = limited || (asked < low) || (asked > high);
    }
    return limited;
#else
    const float left = (channels[0] < 0.0f) ? -channels[0] : channels[0];
    const float right = (channels[1] < 0.0f) ? -channels[1] : channels[1];
    const float largest = (left > right) ? left : right;
    const bool limited = largest > LARGEST;
    if (limited) { /* both together: the force keeps its direction */
        channels[0] = (channels[0] / largest) * LARGEST;
        channels[1] = (channels[1] / largest) * LARGEST;
    }
    return limited;
#endif
}

static void obey(float channels[CHANNELS], unsigned flags)
{
    board.holds = (flags & WITH_HOLD) != 0U;
    board.limited = limit(channels);
    for (size_t k = 0U; k < (size_t)CHANNELS; k++) {
        board.channels[k] = channels[k];
    }
    board.obeyed = port_time();
    happens(ENABLE);
    if (board.state == ENABLED) {
        board.tripped = false;
    }
}

static void say_state(void)
{
    const unsigned sequence = (unsigned)get(2U, 2U);
    unsigned flags = (board.state == ENABLED) ? IS_ENABLED : 0U;
    flags |= board.homed ? IS_HOMED : 0U;
    flags |= board.tripped ? HAS_TRIPPED : 0U;
    flags |= (board.state != BOOT) ? IS_GREETED : 0U;
    flags |= ((board.state == ENABLED) && board.limited) ? IS_LIMITED : 0U;

    filled = 0U;
    add(STATE, 1U);
    add(flags, 1U);
    add(sequence, 2U);
    add(port_time(), 4U);
    for (size_t k = 0U; k < (size_t)JOINTS; k++) {
        add((uint32_t)encoder_counts(&board.encoders[k]), 4U);
    }
    add((uint32_t)board.error, 1U);
#if CABLES
    float reeled[CHANNELS];
    for (unsigned k = 0U; k < (unsigned)CHANNELS; k++) {
        float tension = 0.0f;
        port_cable(k, &tension, &reeled[k]);
        add_single(tension);
    }
    for (unsigned k = 0U; k < (unsigned)CHANNELS; k++) {
        add_single(reeled[k]);
    }
#endif
}

static void command(void)
{
    float channels[CHANNELS];
    const bool good = read_channels(channels);
    const unsigned flags = message[1];

    port_lock(true);
    follow_encoders();
    look_at_the_clock();
    if (!good) {
        fails(BAD_TORQUE, TORQUE_NOT_FINITE);
    } else {
        ends(TORQUE_NOT_FINITE);
        if ((flags & WITH_ENABLE) != 0U) {
            obey(channels, flags);
        } else {
            happens(DISABLE);
        }
    }
    say_state();
    port_lock(false);
    answer();
}

static void home(void)
{
    port_lock(true);
    follow_encoders();
    look_at_the_clock();
    if ((board.state == ENABLED) || (get(1U, 4U) != board.boot)) {
        fails(BAD_HOME, HOME_REFUSED);
    } else {
        for (unsigned k = 0U; k < (unsigned)JOINTS; k++) {
            encoder_home(&board.encoders[k]);
        }
        board.homed = true;
        ends(HOME_REFUSED);
        happens(HOMED);
    }
    port_lock(false);
}

/* ---- the two ways in ----------------------------------------------------------------------- */

void board_start(void)
{
    const board_t fresh = {.state = BOOT, .boot = port_boot()};
    const receiver_t empty = {.fill = 0U};

    board = fresh;
    receiver = empty;
    for (unsigned k = 0U; k < (unsigned)JOINTS; k++) {
        encoder_start(&board.encoders[k], port_encoder(k));
    }
    drive();
}

void board_poll(void)
{
    uint8_t byte = 0U;

    while (port_read(&byte)) {
        const size_t length = frame_take(&receiver, byte, message);
        if ((length >= (size_t)HELLO_BYTES) && (message[0] == (uint8_t)HELLO)) {
            hello();
        } else if ((length == (size_t)COMMAND_BYTES) && (message[0] == (uint8_t)COMMAND)) {
            command();
        } else if ((length == (size_t)HOME_BYTES) && (message[0] == (uint8_t)HOME)) {
            home();
        } else {
            /* half a message, a damaged one, or none of ours: ignored */
        }
    }
}

const board_t *board_now(void)
{
    return &board;
}
