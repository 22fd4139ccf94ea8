#include "frame.h"

uint16_t frame_crc(const uint8_t *data, size_t count)
{
    uint16_t crc = 0xFFFFU;
    for (size_t k = 0U; k < count; k++) {
        uint16_t x = (uint16_t)((crc >> 8) ^ data[k]);
        x = (uint16_t)(x ^ (x >> 4));
        crc = (uint16_t)((uint32_t)crc << 8);
        crc = (uint16_t)(crc ^ ((uint32_t)x << 12) ^ ((uint32_t)x << 5) ^ x);
    }
    return crc;
}

size_t frame_encode(uint8_t message[FRAME_BUFFER], size_t count, uint8_t out[FRAME_BYTES])
{
    const uint16_t crc = frame_crc(message, count);
    size_t mark = 0U;
    size_t k = 1U;

    message[count] = (uint8_t)(crc & 0xFFU);
    message[count + 1U] = (uint8_t)(crc >> 8);
    for (size_t i = 0U; i < (count + 2U); i++) {
        if (message[i] == 0U) {
            out[mark] = (uint8_t)(k - mark);
            mark = k;
        } else {
            out[k] = message[i];
        }
        k++;
    }
    out[mark] = (uint8_t)(k - mark);
    out[k] = 0U;
    return k + 1U;
}

/* Undo the stuffing and look at the CRC; returns the message's length, 0 if it is damaged. */
static size_t decode(const receiver_t *frame, uint8_t message[FRAME_BUFFER])
{
    size_t k = 0U;
    size_t length = 0U;
    bool sound = true;

    while (sound && (k < frame->fill)) {
        const size_t end = k + frame->bytes[k];
        sound = end <= frame->fill;
        k++;
        while (sound && (k < end)) {
            message[length] = frame->bytes[k];
            length++;
            k++;
        }
        if (k < frame->fill) {
            message[length] = 0U;
            length++;
        }
    }
    if (sound && (length >= 3U)) {
        length -= 2U;
        const uint16_t low = message[length];
        const uint16_t high = message[length + 1U];
        sound = frame_crc(message, length) == (uint16_t)(low | (high << 8));
    } else {
        sound = false;
    }
    return sound ? length : 0U;
}

size_t frame_take(receiver_t *receiver, uint8_t byte, uint8_t message[FRAME_BUFFER])
{
    size_t length = 0U;

    if (byte == 0U) {
        if (!receiver->overlong) {
            length = decode(receiver, message);
        }
        receiver->fill = 0U;
        receiver->overlong = false;
    } else if (receiver->fill < (size_t)FRAME_LONGEST) {
        receiver->bytes[receiver->fill] = byte;
        receiver->fill++;
    } else {
        receiver->overlong = true;
    }
    return length;
}
