/* The needle pantograph of the ICube laboratory; a test compares these numbers with the profile. */
#ifndef DEVICE_H
#define DEVICE_H

#define DEVICE_PROFILE "icube"
#define CABLES 0
#define COUNTS_PER_TURN 20000    /* of the joint */
#define INDEX_PERIOD 2000        /* counts between two indices: one turn of the motor; 0: no index */
#define WATCHDOG_MS 20U
#define JOINT_TORQUE 0.6f        /* largest [N m] */
#define GEAR 10.0f               /* turns of the motor per turn of the joint */
#define TORQUE_CONSTANT 0.0364f  /* of the motor [N m/A] */
#define LARGEST_CURRENT 30.0f    /* of the amplifier [A] */
#define HOTTEST 80.0f            /* [degree C] */
#define LEAST_SUPPLY 18.0f       /* [V]: below it the motors are off, or about to be */

#endif
