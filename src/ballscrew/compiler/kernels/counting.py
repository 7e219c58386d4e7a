"""The kernel that fills the histogram of a sketch (:mod:`ballscrew.compiler.kernels.sketch`), and the layout of the
bins.
"""

from __future__ import annotations

import functools

from ballscrew.compiler.kernels.emission import SIGNATURE
from ballscrew.compiler.kernels.kernel import Kernel

#: Bits of the mantissa that tell bins apart.
MANTISSA_BITS = 11
#: Numbers of one octave share sign and exponent, the leading 12 bits; an octave has one row of bins.
FRACTION_BITS = 52
DROPPED_BITS = FRACTION_BITS - MANTISSA_BITS
BINS = 2**MANTISSA_BITS
OCTAVES = 2**12

#: Lanes of a vector, and the statistics of each series.
LANES = 16
STATISTICS = ("count", "mean", "squares", "minimum", "maximum", "uncounted")


@functools.cache
def counting_kernel() -> Kernel:
    """The kernel that counts a unit: values in; starts of octaves, bins and ``STATISTICS`` out."""
    return Kernel.of(_assembly(), ["points"])


def _assembly() -> str:
    """The kernel as assembly: for each series (a row), two passes for the moments, and one that counts.

    The second pass takes out what the mean of the first was off. The passes for the moments go on
    to the end of a vector, so what comes after the numbers must be NaN.
    """
    v, m = f"<{LANES} x double>", f"<{LANES} x i1>"
    nothing, infinity = f"{v} zeroinitializer", f"{v} splat (double 0x7FF0000000000000)"
    minus_infinity, one = f"{v} splat (double 0xFFF0000000000000)", f"{v} splat (double 1.0)"
    read = """  %from_{0} = getelementptr double, ptr %line, i64 %i_{0}
  %x_{0} = load {v}, ptr %from_{0}, align 8
  %size_{0} = call {v} @llvm.fabs.v{lanes}f64({v} %x_{0})
  %is_{0} = fcmp olt {v} %size_{0}, splat (double 0x7FF0000000000000)
"""
    read_1, read_2 = (read.format(i, v=v, lanes=LANES) for i in (1, 2))
    loop_ends = """  %next_{0} = add i64 %i_{0}, {lanes}
  %more_{0} = icmp slt i64 %next_{0}, %column_stop
"""
    ends_1, ends_2 = (loop_ends.format(i, lanes=LANES) for i in (1, 2))
    reduced = "call double @llvm.vector.reduce"
    stores = "".join(
        f"  %to{i} = getelementptr double, ptr %found_here, i64 {i}\n  store double %{name}, ptr %to{i}\n"
        for i, name in enumerate(STATISTICS)
    )
    return f"""define void @kernel({SIGNATURE}) {{
entry:
  %values = load ptr, ptr %inputs
  %starts = load ptr, ptr %outputs
  %bins_entry = getelementptr ptr, ptr %outputs, i64 1
  %bins = load ptr, ptr %bins_entry
  %found_entry = getelementptr ptr, ptr %outputs, i64 2
  %found = load ptr, ptr %found_entry
  br label %row_loop
row_loop:
  %row = phi i64 [ %row_start, %entry ], [ %next_row, %row_done ]
  %first_place = mul i64 %row, %columns
  %line = getelementptr double, ptr %values, i64 %first_place
  %first_start = mul i64 %row, {OCTAVES}
  %starts_here = getelementptr i64, ptr %starts, i64 %first_start
  %first_found = mul i64 %row, {len(STATISTICS)}
  %found_here = getelementptr double, ptr %found, i64 %first_found
  br label %sums
sums:
  %i_1 = phi i64 [ 0, %row_loop ], [ %next_1, %sums ]
  %sum = phi {v} [ zeroinitializer, %row_loop ], [ %new_sum, %sums ]
  %number = phi {v} [ zeroinitializer, %row_loop ], [ %new_number, %sums ]
  %least = phi {v} [ splat (double 0x7FF0000000000000), %row_loop ], [ %new_least, %sums ]
  %largest = phi {v} [ splat (double 0xFFF0000000000000), %row_loop ], [ %new_largest, %sums ]
{read_1}  %term = select {m} %is_1, {v} %x_1, {nothing}
  %new_sum = fadd {v} %sum, %term
  %counted = select {m} %is_1, {one}, {nothing}
  %new_number = fadd {v} %number, %counted
  %low = select {m} %is_1, {v} %x_1, {infinity}
  %is_less = fcmp olt {v} %low, %least
  %new_least = select {m} %is_less, {v} %low, {v} %least
  %high = select {m} %is_1, {v} %x_1, {minus_infinity}
  %is_more = fcmp ogt {v} %high, %largest
  %new_largest = select {m} %is_more, {v} %high, {v} %largest
{ends_1}  br i1 %more_1, label %sums, label %sums_done
sums_done:
  %total = {reduced}.fadd.v{LANES}f64(double 0.0, {v} %new_sum)
  %count = {reduced}.fadd.v{LANES}f64(double 0.0, {v} %new_number)
  %minimum = {reduced}.fmin.v{LANES}f64({v} %new_least)
  %maximum = {reduced}.fmax.v{LANES}f64({v} %new_largest)
  %near_mean = fdiv double %total, %count
  %mean_first = insertelement {v} poison, double %near_mean, i64 0
  %mean_all = shufflevector {v} %mean_first, {v} poison, <{LANES} x i32> zeroinitializer
  br label %deviations
deviations:
  %i_2 = phi i64 [ 0, %sums_done ], [ %next_2, %deviations ]
  %offset = phi {v} [ zeroinitializer, %sums_done ], [ %new_offset, %deviations ]
  %sum_2 = phi {v} [ zeroinitializer, %sums_done ], [ %new_sum_2, %deviations ]
{read_2}  %deviation = fsub {v} %x_2, %mean_all
  %kept = select {m} %is_2, {v} %deviation, {nothing}
  %new_offset = fadd {v} %offset, %kept
  %square = fmul {v} %kept, %kept
  %new_sum_2 = fadd {v} %sum_2, %square
{ends_2}  br i1 %more_2, label %deviations, label %deviations_done
deviations_done:
  %near_squares = {reduced}.fadd.v{LANES}f64(double 0.0, {v} %new_sum_2)
  %total_offset = {reduced}.fadd.v{LANES}f64(double 0.0, {v} %new_offset)
  %mean_offset = fdiv double %total_offset, %count
  %excess = fmul double %total_offset, %mean_offset
  %less_squares = fsub double %near_squares, %excess
  %better_mean = fadd double %near_mean, %mean_offset
  %is_spread = fcmp olt double %minimum, %maximum
  %squares = select i1 %is_spread, double %less_squares, double 0.0
  %is_any = fcmp ogt double %count, 0.0
  %same = select i1 %is_any, double %minimum, double 0x7FF8000000000000
  %mean = select i1 %is_spread, double %better_mean, double %same
  br label %counts
counts:
  %i = phi i64 [ 0, %deviations_done ], [ %next, %counts ]
  %unseen = phi i64 [ 0, %deviations_done ], [ %new_unseen, %counts ]
  %from = getelementptr i64, ptr %line, i64 %i
  %bits = load i64, ptr %from
  %octave = lshr i64 %bits, {FRACTION_BITS}
  %leading = lshr i64 %bits, {DROPPED_BITS}
  %bin = and i64 %leading, {BINS - 1}
  %start_entry = getelementptr i64, ptr %starts_here, i64 %octave
  %start = load i64, ptr %start_entry
  %place = add i64 %start, %bin
  %counter = getelementptr i64, ptr %bins, i64 %place
  %before = load i64, ptr %counter
  %after = add i64 %before, 1
  store i64 %after, ptr %counter
  %is_unseen = icmp eq i64 %start, 0
  %one_unseen = zext i1 %is_unseen to i64
  %new_unseen = add i64 %unseen, %one_unseen
  %next = add i64 %i, 1
  %more = icmp slt i64 %next, %column_stop
  br i1 %more, label %counts, label %row_done
row_done:
  %uncounted = sitofp i64 %new_unseen to double
{stores}  %next_row = add i64 %row, 1
  %more_rows = icmp slt i64 %next_row, %row_stop
  br i1 %more_rows, label %row_loop, label %done
done:
  ret void
}}
"""
