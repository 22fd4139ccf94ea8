/* Registers of the STM32F405 that the port uses, by ST's reference manual RM0090 and ARM's v7-M
 * manual. Offsets are bytes. */
#ifndef REGISTERS_H
#define REGISTERS_H

#include <stdint.h>

#define REG(address) (*(volatile uint32_t *)(uintptr_t)(address))

/* Clocks (RM0090, 7.3) and flash (3.9) */
#define RCC_CR REG(0x40023800U)
#define RCC_PLLCFGR REG(0x40023804U)
#define RCC_CFGR REG(0x40023808U)
#define RCC_AHB1ENR REG(0x40023830U)
#define RCC_AHB2ENR REG(0x40023834U)
#define RCC_APB1ENR REG(0x40023840U)
#define RCC_APB2ENR REG(0x40023844U)
#define FLASH_ACR REG(0x40023C00U)

/* Ports (8.4) */
#define GPIOA 0x40020000U
#define GPIOB 0x40020400U
#define GPIOC 0x40020800U
#define GPIO_MODER(port) REG((port) + 0x00U)
#define GPIO_PUPDR(port) REG((port) + 0x0CU)
#define GPIO_IDR(port) REG((port) + 0x10U)
#define GPIO_BSRR(port) REG((port) + 0x18U)
#define GPIO_AFR(port, pin) REG((port) + 0x20U + (4U * ((pin) / 8U)))

/* Timers (17.4, 18.4) */
#define TIM1 0x40010000U
#define TIM3 0x40000400U
#define TIM8 0x40010400U
#define TIM_CR1(timer) REG((timer) + 0x00U)
#define TIM_SMCR(timer) REG((timer) + 0x08U)
#define TIM_SR(timer) REG((timer) + 0x10U)
#define TIM_EGR(timer) REG((timer) + 0x14U)
#define TIM_CCMR1(timer) REG((timer) + 0x18U)
#define TIM_CCMR2(timer) REG((timer) + 0x1CU)
#define TIM_CCER(timer) REG((timer) + 0x20U)
#define TIM_CNT(timer) REG((timer) + 0x24U)
#define TIM_ARR(timer) REG((timer) + 0x2CU)
#define TIM_CCR(timer, channel) REG((timer) + 0x30U + (4U * (channel))) /* channels from 1 */

/* Serial line (30.6) */
#define USART1_SR REG(0x40011000U)
#define USART1_DR REG(0x40011004U)
#define USART1_BRR REG(0x40011008U)
#define USART1_CR1 REG(0x4001100CU)

/* Analogue inputs (13.13) */
#define ADC1_CR1 REG(0x40012004U)
#define ADC1_CR2 REG(0x40012008U)
#define ADC1_SMPR2 REG(0x40012010U)
#define ADC1_JSQR REG(0x40012038U)
#define ADC1_JDR(k) REG(0x40012038U + (4U * (k))) /* from 1 */
#define ADC_CCR REG(0x40012304U)

/* Random numbers (24.8), independent watchdog (21.4) */
#define RNG_CR REG(0x50060800U)
#define RNG_SR REG(0x50060804U)
#define RNG_DR REG(0x50060808U)
#define IWDG_KR REG(0x40003000U)
#define IWDG_PR REG(0x40003004U)
#define IWDG_RLR REG(0x40003008U)

/* Core: SysTick, interrupts, coprocessors */
#define SYST_CSR REG(0xE000E010U)
#define SYST_RVR REG(0xE000E014U)
#define SYST_CVR REG(0xE000E018U)
#define NVIC_ISER(k) REG(0xE000E100U + (4U * (k)))
#define NVIC_IPR_BYTE(irq) (*(volatile uint8_t *)(uintptr_t)(0xE000E400U + (irq)))
#define SCB_ICSR REG(0xE000ED04U)
#define SCB_SHPR3 REG(0xE000ED20U)
#define SCB_CPACR REG(0xE000ED88U)

#endif
