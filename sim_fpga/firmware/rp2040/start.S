@ From the vectors to main: the loader copies the program to the RAM, where it runs without waiting for the flash.
  .syntax unified
  .cpu cortex-m0plus
  .thumb

  .section .flash_vectors, "a"
  .word stack_end
  .word load

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
  ldr r0, =start
  bx r0
  .ltorg

  .section .vectors, "a"
  .word stack_end
  .word start
  .word stopped          @ not maskable
  .word stopped          @ hard fault
  .fill 7, 4, 0
  .word stopped          @ supervisor call
  .fill 2, 4, 0
  .word stopped          @ pending supervisor call
  .word stopped          @ system tick
  .word on_feed_time         @ interrupts 0 and 1: alarms of the timer
  .word on_render_time
  .rept 18
  .word stopped
  .endr
  .word on_uart          @ interrupt 20: UART 0
  .rept 11
  .word stopped
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
