/* STM32F405 (Cortex-M4 at 168 MHz from its own oscillator), bare metal.
 *
 *   PB6, PB7        serial line out and in, 1 Mbaud                       USART1
 *   PA8, PA9, PA10  left encoder: A, B, index                             TIM1
 *   PC6, PC7, PC8   right encoder: A, B, index                            TIM8
 *   PA6, PA7        left and right set value, PWM 5 kHz: 50 % no current,
 *                   10 % and 90 % the amplifier's largest                 TIM3
 *   PB12            enable of both amplifiers; a resistor pulls it down
 *   PB13            high while both amplifiers are ready
 *   PA0, PA1        temperature of either motor, 0.5 V + 10 mV/degree C   ADC1
 *   PA2             motor supply behind the switch, divided by 11         ADC1
 *
 * With BOARD_IS_A_PROGRAM it runs in QEMU's netduinoplus2, which has no clock tree, analogue inputs
 * or random numbers. */
#include "board.h"
#include "port.h"
#include "registers.h"

#if CABLES
#error "this port drives two motors; four winches need four more encoders"
#endif

enum {
    CLOCK = 168000000, BAUD = 1000000, PWM_PERIOD = 16800,
    USART1_IRQ = 37, SERIAL_PRIORITY = 0x20, TICK_PRIORITY = 0x40,
    RING = 256 /* a power of two */
};

static const uint32_t encoder_timer[JOINTS] = {TIM1, TIM8};
static volatile uint32_t milliseconds;
static volatile uint8_t in[RING], out[RING];
static volatile uint32_t in_head, in_tail, out_head, out_tail;

/* ---- set-up -------------------------------------------------------------------------------- */

static void set_clocks(void)
{
#ifndef BOARD_IS_A_PROGRAM
    FLASH_ACR = 0x705U;                                     /* 5 wait states, caches */
    RCC_PLLCFGR = 16U | (336U << 6) | (7U << 24);           /* 16 MHz / 16 * 336 / 2; / 7 */
    RCC_CR |= 1U << 24;
    while ((RCC_CR & (1U << 25)) == 0U) {
    }
    RCC_CFGR = (5U << 10) | (4U << 13) | 2U;                /* APB1 42 MHz, APB2 84 MHz */
    while ((RCC_CFGR & 0xCU) != 0x8U) {
    }
#endif
    RCC_AHB1ENR |= 7U;                                      /* ports A, B, C */
    RCC_AHB2ENR |= 1U << 6;                                 /* random numbers */
    RCC_APB1ENR |= 1U << 1;                                 /* TIM3 */
    RCC_APB2ENR |= 1U | (1U << 1) | (1U << 4) | (1U << 8);  /* TIM1, TIM8, USART1, ADC1 */
}

static void set_pin(uint32_t port, uint32_t pin, uint32_t mode, uint32_t function)
{
    const uint32_t shift = 4U * (pin % 8U);
    GPIO_AFR(port, pin) = (GPIO_AFR(port, pin) & ~(0xFU << shift)) | (function << shift);
    GPIO_MODER(port) = (GPIO_MODER(port) & ~(3U << (2U * pin))) | (mode << (2U * pin));
}

static void set_pins(void)
{
    enum { OUTPUT = 1, ALTERNATE = 2, ANALOGUE = 3 };

    GPIO_BSRR(GPIOB) = 1U << (12U + 16U); /* amplifiers off, before the pin drives */
    set_pin(GPIOB, 12U, OUTPUT, 0U);
    GPIO_PUPDR(GPIOB) |= 2U << 26; /* PB13 down: no plug, not ready */
    for (uint32_t k = 0U; k < 3U; k++) {
        set_pin(GPIOA, 8U + k, ALTERNATE, 1U);
        set_pin(GPIOC, 6U + k, ALTERNATE, 3U);
        set_pin(GPIOA, k, ANALOGUE, 0U);
    }
    for (uint32_t pin = 6U; pin <= 7U; pin++) {
        set_pin(GPIOA, pin, ALTERNATE, 2U);
        set_pin(GPIOB, pin, ALTERNATE, 7U);
    }
}

static void set_encoder(uint32_t timer)
{
    TIM_ARR(timer) = 0xFFFFU;
    TIM_CCMR1(timer) = 0x3131U; /* both inputs, eight equal samples */
    TIM_CCMR2(timer) = 0x0031U; /* the index latches the counter */
    TIM_CCER(timer) = 1U << 8;
    TIM_SMCR(timer) = 3U; /* every edge of both */
    TIM_CR1(timer) = 1U;
}

static void set_motors(void)
{
    TIM_ARR(TIM3) = (uint32_t)PWM_PERIOD - 1U;
    TIM_CCMR1(TIM3) = 0x6868U; /* high until the set value, which changes with the period */
    TIM_CCR(TIM3, 1U) = TIM_CCR(TIM3, 2U) = (uint32_t)PWM_PERIOD / 2U;
    TIM_CCER(TIM3) = 0x11U;
    TIM_EGR(TIM3) = 1U;
    TIM_CR1(TIM3) = 0x81U;
}

static void set_analogue(void)
{
    ADC_CCR = 1U << 16;                             /* 21 MHz */
    ADC1_CR1 = 1U << 8;                             /* a sequence */
    ADC1_SMPR2 = (4U << 0) | (4U << 3) | (4U << 6); /* 84 cycles each */
    ADC1_JSQR = (2U << 20) | (0U << 5) | (1U << 10) | (2U << 15);
    ADC1_CR2 = 1U;
}

static void set_serial(void)
{
    USART1_BRR = ((uint32_t)CLOCK / 2U) / (uint32_t)BAUD;
    USART1_CR1 = (1U << 13) | (1U << 5) | (1U << 3) | (1U << 2); /* on, interrupt, out, in */
    NVIC_IPR_BYTE(USART1_IRQ) = SERIAL_PRIORITY;
    NVIC_ISER(1U) = 1U << (USART1_IRQ - 32);
}

static void set_tick(void)
{
    IWDG_KR = 0x5555U;
    IWDG_PR = 0U;     /* 32 kHz / 4 */
    IWDG_RLR = 127U;  /* 16 ms, 11 to 30 as the oscillator is: a tick that hangs resets the chip */
    IWDG_KR = 0xCCCCU;
    SCB_SHPR3 = (uint32_t)TICK_PRIORITY << 24;
    SYST_RVR = ((uint32_t)CLOCK / 1000U) - 1U;
    SYST_CVR = 0U;
    SYST_CSR = 7U;
}

/* ---- what the core asks for ---------------------------------------------------------------- */

uint32_t port_boot(void)
{
#ifdef BOARD_IS_A_PROGRAM
    return 1U;
#else
    RNG_CR = 4U;
    while ((RNG_SR & 1U) == 0U) {
    }
    return RNG_DR;
#endif
}

uint32_t port_time(void)
{
    uint32_t before, left;
    do { /* a tick may come in between; while it is kept from running it is pending */
        before = milliseconds;
        left = SYST_CVR;
        if ((SCB_ICSR & (1U << 26)) != 0U) {
            left = SYST_CVR;
            before++;
        }
    } while ((before - milliseconds) > 1U);
    return (before * 1000U) + ((SYST_RVR - left) / ((uint32_t)CLOCK / 1000000U));
}

/* Give the line the next byte of the answer, if it takes one. */
static void send(void)
{
    if ((out_tail != out_head) && ((USART1_SR & (1U << 7)) != 0U)) {
        USART1_DR = out[out_tail % RING];
        out_tail++;
    }
}

bool port_read(uint8_t *byte)
{
    send();
    if (in_tail == in_head) {
        return false;
    }
    *byte = in[in_tail % RING];
    in_tail++;
    return true;
}

void port_write(const uint8_t *bytes, size_t count)
{
    if ((out_head - out_tail) + count > (uint32_t)RING) {
        return;
    }
    for (size_t k = 0U; k < count; k++) {
        out[out_head % RING] = bytes[k];
        out_head++;
    }
}

uint16_t port_encoder(unsigned joint)
{
    return (uint16_t)TIM_CNT(encoder_timer[joint]);
}

bool port_index(unsigned joint, uint16_t *latched)
{
    const bool passed = (TIM_SR(encoder_timer[joint]) & (1U << 3)) != 0U;
    if (passed) {
        *latched = (uint16_t)TIM_CCR(encoder_timer[joint], 3U); /* which clears the flag */
    }
    return passed;
}

#ifdef BOARD_IS_A_PROGRAM
health_t port_health(void)
{
    const health_t health = {.hottest = 25.0f, .supply = 24.0f, .ready = true};
    return health;
}
#else
static float volts(uint32_t k)
{
    return (float)ADC1_JDR(k) * (3.3f / 4095.0f);
}

static float celsius(uint32_t k)
{
    const float found = (volts(k) - 0.5f) * 100.0f;
    return (found < -20.0f) ? 999.0f : found; /* so cold is a sensor that has come off */
}

health_t port_health(void)
{
    const float left = celsius(1U);
    const float right = celsius(2U);
    const health_t health = {.hottest = (left > right) ? left : right,
                             .supply = volts(3U) * 11.0f,
                             .ready = (GPIO_IDR(GPIOB) & (1U << 13)) != 0U};
    ADC1_CR2 |= 1U << 22; /* measure for the next tick */
    return health;
}
#endif

void port_current(unsigned motor, float current)
{
    const float share = 0.5f + (0.4f * current / LARGEST_CURRENT);
    TIM_CCR(TIM3, motor + 1U) = (uint32_t)(share * (float)PWM_PERIOD);
}

void port_enable(bool on)
{
    GPIO_BSRR(GPIOB) = on ? (1U << 12) : (1U << (12U + 16U));
}

void port_lock(bool on)
{
    __asm volatile("msr basepri, %0" : : "r"(on ? (uint32_t)TICK_PRIORITY : 0U) : "memory");
}

/* ---- interrupts and start ------------------------------------------------------------------ */

static void on_tick(void)
{
    milliseconds++;
    board_tick();
    IWDG_KR = 0xAAAAU;
}

static void on_serial(void)
{
    const uint32_t status = USART1_SR;
    const uint32_t byte = USART1_DR; /* which clears an overrun too */
    if (((status & (1U << 5)) != 0U) && ((in_head - in_tail) < (uint32_t)RING)) {
        in[in_head % RING] = (uint8_t)byte;
        in_head++;
    }
}

/* Whatever else: motors off; the watchdog restarts the chip. */
static void on_fault(void)
{
    port_enable(false);
    for (;;) {
    }
}

static void sleep_until_something_comes(void)
{
    __asm volatile("cpsid i" : : : "memory"); /* an interrupt that is kept wakes it too */
    if ((in_head == in_tail) && (out_head == out_tail)) {
        __asm volatile("wfi");
    }
    __asm volatile("cpsie i" : : : "memory");
}

/* The compiler calls these two for structures, library or not. */
void *memset(void *to, int value, size_t count);
void *memcpy(void *to, const void *from, size_t count);

void *memset(void *to, int value, size_t count)
{
    for (size_t k = 0U; k < count; k++) {
        ((uint8_t *)to)[k] = (uint8_t)value;
    }
    return to;
}

void *memcpy(void *to, const void *from, size_t count)
{
    for (size_t k = 0U; k < count; k++) {
        ((uint8_t *)to)[k] = ((const uint8_t *)from)[k];
    }
    return to;
}

extern uint32_t _data, _data_end, _data_kept, _bss, _bss_end, _stack_top;

__attribute__((noreturn)) void reset(void);
void reset(void)
{
    const uint32_t *from = &_data_kept;
    for (uint32_t *to = &_data; to < &_data_end; to++) {
        *to = *from;
        from++;
    }
    for (uint32_t *to = &_bss; to < &_bss_end; to++) {
        *to = 0U;
    }
    SCB_CPACR |= 0xFU << 20; /* the unit for floats */
    set_clocks();
    set_pins();
    set_motors();
    set_encoder(TIM1);
    set_encoder(TIM8);
    set_analogue();
    set_serial();
    board_start();
    set_tick();
    for (;;) {
        board_poll();
        sleep_until_something_comes();
    }
}

typedef void (*handler_t)(void);

__attribute__((section(".vectors"), used)) static const handler_t vectors[16 + USART1_IRQ + 1] = {
    [0] = (handler_t)(uintptr_t)&_stack_top,
    [1] = reset,
    [2 ... 14] = on_fault,
    [15] = on_tick,
    [16 ... 15 + USART1_IRQ] = on_fault,
    [16 + USART1_IRQ] = on_serial,
};
