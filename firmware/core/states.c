#include "states.h"

state_t state_after(state_t state, event_t event)
{
    /* clang-format off */
    static const state_t next[STATES][EVENTS] = {
        /*             GREETED ESTRANGED ENABLE    DISABLE   BAD_TORQUE HOMED     BAD_HOME LATE      BROKEN */
        [BOOT]     = { IDLE,   BOOT,     BOOT,     BOOT,     BOOT,      BOOT,     BOOT,    BOOT,     BOOT  },
        [IDLE]     = { IDLE,   BOOT,     ENABLED,  IDLE,     REJECTED,  IDLE,     REFUSED, IDLE,     FAULT },
        [ENABLED]  = { IDLE,   BOOT,     ENABLED,  IDLE,     REJECTED,  IDLE,     REFUSED, IDLE,     FAULT },
        [REJECTED] = { IDLE,   BOOT,     ENABLED,  IDLE,     REJECTED,  REJECTED, REFUSED, REJECTED, FAULT },
        [REFUSED]  = { IDLE,   BOOT,     REFUSED,  REFUSED,  REFUSED,   IDLE,     REFUSED, REFUSED,  FAULT },
        [FAULT]    = { IDLE,   BOOT,     FAULT,    FAULT,    FAULT,     FAULT,    FAULT,   FAULT,    FAULT },
    };
    /* clang-format on */

    return next[state][event];
}
