# SPDX-License-Identifier: MIT
import signal

# A process that is started in the background ignores Ctrl-C, and Python then installs no handler of its own.
signal.signal(signal.SIGINT, signal.default_int_handler)
