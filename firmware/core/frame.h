/* Frames on the wire: COBS(message, CRC low byte, CRC high byte), 0 (docs/protocol.md). */
#ifndef FRAME_H
#define FRAME_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    FRAME_MESSAGE = 64, /* longest message */
    FRAME_BUFFER = 66,  /* the same with its CRC */
    FRAME_LONGEST = 67, /* longest frame without its zero */
    FRAME_BYTES = 68
};

typedef struct {
    uint8_t bytes[FRAME_LONGEST];
    size_t fill;
    bool overlong;
} receiver_t;

/* CRC-16/CCITT-FALSE; of the characters 1 to 9 it is 0x29B1. */
uint16_t frame_crc(const uint8_t *data, size_t count);

/* Write the frame of a message to `out`; return its length. The message's buffer takes the CRC. */
size_t frame_encode(uint8_t message[FRAME_BUFFER], size_t count, uint8_t out[FRAME_BYTES]);

/* Take a byte. Returns the length of the message that is complete now; 0: none, or a damaged one. */
size_t frame_take(receiver_t *receiver, uint8_t byte, uint8_t message[FRAME_BUFFER]);

#endif
