"""What all tests need."""

import signal

# A process started in the background by a shell ignores Ctrl-C, and its children do; the tests send it to themselves.
signal.signal(signal.SIGINT, signal.default_int_handler)
