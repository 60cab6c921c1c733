"""Other ways to the same sweeps: closed forms by hand, in numpy and in C."""
