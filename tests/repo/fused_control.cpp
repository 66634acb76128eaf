// SPDX-License-Identifier: MIT
// Compiled with contraction: no_fma.sh must find a fused multiply-add here.
// NOLINTNEXTLINE(misc-use-internal-linkage): it would not be compiled
double fused_control(double a, double b, double c);
double fused_control(double a, double b, double c) { return a * b + c; }
