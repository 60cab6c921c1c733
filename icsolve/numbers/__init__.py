"""Arithmetics on which the same kernels run, the operations with their derivatives, linear systems, roots."""
