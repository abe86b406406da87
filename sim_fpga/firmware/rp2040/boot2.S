@ The second stage of booting: the boot ROM copies these 256 bytes from the flash, checks their CRC (pack_uf2.py computes
@ it) and calls them. They set up reading of the flash at its addresses, with the command 03h, which every flash has, and
@ jump by the vectors that follow them in the flash.
  .syntax unified
  .cpu cortex-m0plus
  .thumb

  .equ SSI, 0x18000000
  .equ CTRLR0, 0x00
  .equ CTRLR1, 0x04
  .equ SSIENR, 0x08
  .equ BAUDR, 0x14
  .equ SPI_CTRLR0, 0xf4

  .section .boot2, "ax"
  ldr r0, =SSI
  movs r1, #0
  str r1, [r0, #SSIENR]      @ off while it changes
  movs r2, #4
  str r2, [r0, #BAUDR]       @ a quarter of the processor's clock
  ldr r2, =0x001f0300        @ words of 32 bits; EEPROM read: a command, then data
  str r2, [r0, #CTRLR0]
  str r1, [r0, #CTRLR1]      @ one word a read
  ldr r2, =0x03000218        @ command 03h of 8 bits, an address of 24 bits, one line
  movs r3, #SPI_CTRLR0
  str r2, [r0, r3]
  movs r1, #1
  str r1, [r0, #SSIENR]
  ldr r0, =0x10000100        @ the vectors behind this stage
  ldm r0!, {r1, r2}          @ stack, entry
  mov sp, r1
  bx r2
  .ltorg
  .org 0x100                 @ the CRC is in the last four bytes
