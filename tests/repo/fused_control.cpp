// SPDX-License-Identifier: MIT
// Compiled with contraction on, so that no_fma.sh has something to find.
double fused_control(double a, double b, double c);
double fused_control(double a, double b, double c) { return a * b + c; }
