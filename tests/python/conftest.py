# SPDX-License-Identifier: MIT
import signal

# What is started in the background inherits that Ctrl-C is ignored, and Python then installs no handler of its own.
signal.signal(signal.SIGINT, signal.default_int_handler)
