"""Blocks of configurations: how the kernels for many configurations lay out their numbers.

What belongs to one configuration is spread: each number of it, such as an entry of J, stands in a row of its own, with
one place for each configuration of the block. An operation is then a loop along a row, that LLVM turns into vector
instructions, eight configurations at a time where the processor has AVX-512; and a block fits the first-level cache.
The loops are written out, since a slice of an array costs the compiler more than the loop.
"""

BLOCK = 64  # with 16 and 32, LLVM unrolls the loops, and the rate is 0.6 of this; with 128 it is 1.05 times this
