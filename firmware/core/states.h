/* The board's states and what leads from one to the next; the model in ../model proves them. */
#ifndef STATES_H
#define STATES_H

typedef enum {
    BOOT,     /* not greeted in this board's version: no torque */
    IDLE,     /* greeted, motors off */
    ENABLED,  /* the motors follow the commands */
    REJECTED, /* error 1, until a good command */
    REFUSED,  /* error 2, until a HOME that is obeyed */
    FAULT,    /* errors 3 to 7, until HELLO */
    STATES
} state_t;

typedef enum {
    GREETED,    /* HELLO of this board's version */
    ESTRANGED,  /* HELLO of another */
    ENABLE,     /* a good command with enable */
    DISABLE,    /* a good command without */
    BAD_TORQUE, /* a command with a torque that is not finite */
    HOMED,      /* a HOME that is obeyed */
    BAD_HOME,   /* a HOME that is not */
    LATE,       /* no command with enable for too long */
    BROKEN,     /* encoder, amplifier, supply, heat, or the program itself */
    EVENTS
} event_t;

state_t state_after(state_t state, event_t event);

#endif
