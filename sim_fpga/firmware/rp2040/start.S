@ From the vectors to main: the loader copies the program to the RAM, where it runs without waiting for the flash.
  .syntax unified
  .cpu cortex-m0plus
  .thumb

  .section .flash_vectors, "a"
  .word stack_end
  .word load + 1

  .section .load, "ax"
  .thumb_func
load:
  ldr r0, =image_in_flash
  ldr r1, =image_begin
  ldr r2, =image_end
copy:
  ldm r0!, {r3}
  stm r1!, {r3}
  cmp r1, r2
  blo copy
  ldr r0, =start + 1
  bx r0
  .ltorg

  .section .vectors, "a"
  .word stack_end
  .word start + 1
  .word stopped + 1          @ not maskable
  .word stopped + 1          @ hard fault
  .fill 7, 4, 0
  .word stopped + 1          @ supervisor call
  .fill 2, 4, 0
  .word stopped + 1          @ pending supervisor call
  .word stopped + 1          @ system tick
  .word on_render_time + 1   @ interrupt 0: alarm 0 of the timer
  .rept 19
  .word stopped + 1
  .endr
  .word on_uart + 1          @ interrupt 20: UART 0
  .rept 11
  .word stopped + 1
  .endr

  .section .text.start, "ax"
  .thumb_func
  .global start
start:
  ldr r0, =image_begin       @ the vectors are at the beginning of the image
  ldr r1, =0xe000ed08        @ VTOR
  str r0, [r1]
  ldr r0, =stack_end
  mov sp, r0
  ldr r1, =bss_begin
  ldr r2, =bss_end
  movs r0, #0
clear:
  cmp r1, r2
  bhs cleared
  stm r1!, {r0}
  b clear
cleared:
  bl main
  .thumb_func
  .global stopped
stopped:
  cpsid i
  bkpt #0
  b stopped
  .ltorg
