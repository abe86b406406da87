@ uint32_t lockstep_add_ticks(Accumulators* axis, uint32_t ticks): 5 cycles a tick. device/add_ticks.cpp is the same in C++.
  .syntax unified
  .cpu cortex-m0plus
  .thumb

  .equ TICK_BYTES, 10        @ five instructions

  .section .text.add_ticks, "ax"
  .thumb_func
  .global lockstep_add_ticks
  .p2align 2
lockstep_add_ticks:
  push {r4-r7, lr}
  mov ip, r0
  movs r2, #TICK_BYTES
  muls r1, r2, r1
  ldr r2, =added + 1
  subs r2, r2, r1            @ so many ticks before the end
  mov lr, r2
  ldm r0!, {r1-r6}           @ phase r2:r1, velocity r4:r3, acceleration r6:r5
  movs r7, #0
  bx lr
  .rept 32
  adds r3, r3, r5
  adcs r4, r6
  adds r1, r1, r3
  adcs r2, r4
  adcs r7, r7                @ the carry is the step
  .endr
added:
  mov r0, ip
  stm r0!, {r1-r4}
  mov r0, r7
  pop {r4-r7, pc}
  .ltorg
