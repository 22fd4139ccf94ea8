/* The board as a model: `make model` has SPIN look at every order of messages, ticks and faults.
 *
 * The table of states is table.pml, which a test holds equal to core/states.c. What is written here
 * by hand is what core/board.c does around it: each message and each tick is one step, because
 * either keeps the other from running (port_lock). */
#include "table.pml"

#define TRIP 18 /* ticks, of TRIP_US */
#define WATCHDOG 20

byte state = BOOT;
bool torque = false;  /* the motors are driven */
byte age = 0;         /* ticks since the newest command with enable */
bool ailing = false;  /* heat, supply or amplifier, as it is */
bool latched = false; /* something broke since the last HELLO */
bool greeted = false; /* ever */
bool stopped = false; /* nothing is sent any more */

inline happens(event)
{
    skip;
    NEXT(state, event);
    torque = (state == ENABLED)
}

inline breaks()
{
    latched = true;
    happens(BROKEN)
}

/* Whatever may be sent, in any order, or nothing more at all. */
active proctype program()
{
    do
    :: d_step { latched = false; greeted = true; happens(GREETED); if :: ailing -> breaks() :: else fi }
    :: d_step { latched = false; happens(ESTRANGED); if :: ailing -> breaks() :: else fi }
    :: d_step { age = 0; happens(ENABLE) }
    :: d_step { happens(DISABLE) }
    :: d_step { happens(BAD_TORQUE) }
    :: d_step { if :: state == ENABLED -> happens(BAD_HOME) :: else -> happens(HOMED) fi }
    :: d_step { happens(BAD_HOME) } /* of another power cycle */
    :: break
    od;
    stopped = true
}

active proctype timer()
{
    do
    :: d_step {
        if :: age < WATCHDOG + 1 -> age++ :: else fi;
        if :: ailing -> breaks() :: else fi;
        if :: state == ENABLED && age >= TRIP -> happens(LATE) :: else fi
       }
    od
}

active proctype world()
{
    do
    :: ailing = true
    :: ailing = false
    :: d_step { breaks() } /* an encoder */
    od
}

ltl fresh { [] (torque -> (state == ENABLED && age < WATCHDOG)) }
ltl safe { [] (latched -> !torque) }
ltl kept { [] ((state == FAULT) -> latched) }
ltl held { [] ((latched && state != BOOT) -> state == FAULT) }
ltl greeting { (!torque) W greeted }
ltl ends { [] (stopped -> <> [] !torque) }
