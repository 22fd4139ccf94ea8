/* The needle holder with four winches; a test compares these numbers with the profile. */
#ifndef DEVICE_H
#define DEVICE_H

#define DEVICE_PROFILE "tensegrity"
#define CABLES 1
#define COUNTS_PER_TURN 2000
#define INDEX_PERIOD 2000
#define WATCHDOG_MS 20U
#define TENSION 200.0f           /* largest [N] */
#define NEWTON_PER_AMPERE 20.0f  /* of a winch: motor, gear and drum */
#define LARGEST_CURRENT 10.0f    /* [A] */
#define FASTEST 0.25f            /* of reeling [m/s] */
#define HOTTEST 80.0f            /* [degree C] */
#define LEAST_SUPPLY 18.0f       /* [V]: below it the motors are off, or about to be */

#endif
