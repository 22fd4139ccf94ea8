/* written from core/states.c by a test's rig; do not edit */
#define BOOT 0
#define IDLE 1
#define ENABLED 2
#define REJECTED 3
#define REFUSED 4
#define FAULT 5
#define GREETED 0
#define ESTRANGED 1
#define ENABLE 2
#define DISABLE 3
#define BAD_TORQUE 4
#define HOMED 5
#define BAD_HOME 6
#define LATE 7
#define BROKEN 8

inline NEXT(s, e)
{
    if
    :: s == BOOT && e == GREETED -> s = IDLE
    :: s == IDLE && e == ESTRANGED -> s = BOOT
    :: s == IDLE && e == ENABLE -> s = ENABLED
    :: s == IDLE && e == BAD_TORQUE -> s = REJECTED
    :: s == IDLE && e == BAD_HOME -> s = REFUSED
    :: s == IDLE && e == BROKEN -> s = FAULT
    :: s == ENABLED && e == GREETED -> s = IDLE
    :: s == ENABLED && e == ESTRANGED -> s = BOOT
    :: s == ENABLED && e == DISABLE -> s = IDLE
    :: s == ENABLED && e == BAD_TORQUE -> s = REJECTED
    :: s == ENABLED && e == HOMED -> s = IDLE
    :: s == ENABLED && e == BAD_HOME -> s = REFUSED
    :: s == ENABLED && e == LATE -> s = IDLE
    :: s == ENABLED && e == BROKEN -> s = FAULT
    :: s == REJECTED && e == GREETED -> s = IDLE
    :: s == REJECTED && e == ESTRANGED -> s = BOOT
    :: s == REJECTED && e == ENABLE -> s = ENABLED
    :: s == REJECTED && e == DISABLE -> s = IDLE
    :: s == REJECTED && e == BAD_HOME -> s = REFUSED
    :: s == REJECTED && e == BROKEN -> s = FAULT
    :: s == REFUSED && e == GREETED -> s = IDLE
    :: s == REFUSED && e == ESTRANGED -> s = BOOT
    :: s == REFUSED && e == HOMED -> s = IDLE
    :: s == REFUSED && e == BROKEN -> s = FAULT
    :: s == FAULT && e == GREETED -> s = IDLE
    :: s == FAULT && e == ESTRANGED -> s = BOOT
    :: else
    fi
}
