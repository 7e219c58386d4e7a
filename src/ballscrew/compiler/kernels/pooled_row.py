"""The kernel of a row whose members may not run into each other: pooling of adjacent violators, one number at a time.

Each member of the row pulls towards a value of its own, by a force that is linear in the difference and ends at a
limit, and resists any value but zero by a dry friction. Neighbours that are bound may part upwards, never downwards.
Members that would run into each other are one block with one value, at which the forces on them add up to nothing; the
forces between neighbours are sums of those behind.

There is nothing to do side by side: each step of the pooling waits for the one before, and so the assembly is written
with plain numbers, not with vectors. What asks for the kernel has the same steps in Python, and with them the reasons.
"""

from __future__ import annotations

import functools

import numpy as np
from numpy.typing import NDArray

from ballscrew.compiler.kernels.emission import SIGNATURE, pointers
from ballscrew.compiler.kernels.kernel import Kernel
from ballscrew.compiler.tracing.program import Source

Field = NDArray[np.float64]

#: Arrays that are read: values, slopes, limits, dry friction, and 1 where a member is bound to the next one.
INPUTS = 5
#: Arrays that are written: values, forces between neighbours, pulls; then blocks: where they begin, and their values.
OUTPUTS = 5


#: The value at which the forces on the members of a block add up to nothing: a walk from break to break of a broken
#: line.
_BLOCK = """
define internal double @block(ptr %value, ptr %slope, ptr %limit, ptr %friction, i64 %start, i64 %end, double %guess) {
entry:
  br label %walk
walk:
  %w = phi double [ %guess, %entry ], [ %next_up, %rise ], [ %next_down, %fall ]
  %positive = fcmp ogt double %w, 0.0
  %negative = fcmp olt double %w, 0.0
  br label %member
member:
  %j = phi i64 [ %start, %walk ], [ %following, %member ]
  %above_before = phi double [ 0.0, %walk ], [ %above, %member ]
  %below_before = phi double [ 0.0, %walk ], [ %below, %member ]
  %up_before = phi double [ 0.0, %walk ], [ %up, %member ]
  %down_before = phi double [ 0.0, %walk ], [ %down, %member ]
  %next_up_before = phi double [ 0x7FF0000000000000, %walk ], [ %next_up, %member ]
  %next_down_before = phi double [ 0xFFF0000000000000, %walk ], [ %next_down, %member ]
  %value_at = getelementptr double, ptr %value, i64 %j
  %slope_at = getelementptr double, ptr %slope, i64 %j
  %limit_at = getelementptr double, ptr %limit, i64 %j
  %friction_at = getelementptr double, ptr %friction, i64 %j
  %v = load double, ptr %value_at
  %k = load double, ptr %slope_at
  %l = load double, ptr %limit_at
  %f = load double, ptr %friction_at
  %pulls = fcmp ogt double %k, 0.0
  %divisor = select i1 %pulls, double %k, double 1.0
  %slack = fdiv double %l, %divisor
  %low = fsub double %v, %slack
  %high = fadd double %v, %slack
  %difference = fsub double %v, %w
  %linear = fmul double %k, %difference
  %least = fneg double %l
  %at_least = fcmp oge double %w, %high
  %at_most = fcmp ole double %w, %low
  %bounded = select i1 %at_least, double %least, double %linear
  %limited = select i1 %at_most, double %l, double %bounded
  %pull = select i1 %pulls, double %limited, double 0.0
  %above_pulled = fadd double %above_before, %pull
  %below_pulled = fadd double %below_before, %pull
  %under_low = fcmp olt double %w, %low
  %under_high = fcmp olt double %w, %high
  %over_low = fcmp ogt double %w, %low
  %over_high = fcmp ogt double %w, %high
  %break_up = select i1 %under_low, double %low, double %high
  %sooner_up = fcmp olt double %break_up, %next_up_before
  %has_up = and i1 %pulls, %under_high
  %takes_up = and i1 %has_up, %sooner_up
  %next_up_pulled = select i1 %takes_up, double %break_up, double %next_up_before
  %not_under_low = xor i1 %under_low, true
  %falls_up = and i1 %has_up, %not_under_low
  %slope_up = select i1 %falls_up, double %k, double 0.0
  %up = fadd double %up_before, %slope_up
  %break_down = select i1 %over_high, double %high, double %low
  %sooner_down = fcmp ogt double %break_down, %next_down_before
  %has_down = and i1 %pulls, %over_low
  %takes_down = and i1 %has_down, %sooner_down
  %next_down_pulled = select i1 %takes_down, double %break_down, double %next_down_before
  %not_over_high = xor i1 %over_high, true
  %falls_down = and i1 %has_down, %not_over_high
  %slope_down = select i1 %falls_down, double %k, double 0.0
  %down = fadd double %down_before, %slope_down
  %rubs = fcmp ogt double %f, 0.0
  %back = fneg double %f
  %rubs_above = select i1 %negative, double %f, double %back
  %rubs_below = select i1 %positive, double %back, double %f
  %friction_above = select i1 %rubs, double %rubs_above, double 0.0
  %friction_below = select i1 %rubs, double %rubs_below, double 0.0
  %above = fadd double %above_pulled, %friction_above
  %below = fadd double %below_pulled, %friction_below
  %zero_is_up = fcmp ogt double %next_up_pulled, 0.0
  %zero_is_down = fcmp olt double %next_down_pulled, 0.0
  %rubs_up = and i1 %rubs, %negative
  %rubs_down = and i1 %rubs, %positive
  %stops_up = and i1 %rubs_up, %zero_is_up
  %stops_down = and i1 %rubs_down, %zero_is_down
  %next_up = select i1 %stops_up, double 0.0, double %next_up_pulled
  %next_down = select i1 %stops_down, double 0.0, double %next_down_pulled
  %following = add i64 %j, 1
  %more = icmp slt i64 %following, %end
  br i1 %more, label %member, label %judge
judge:
  %rises = fcmp ogt double %above, 0.0
  br i1 %rises, label %rise, label %not_up
not_up:
  %sinks = fcmp olt double %below, 0.0
  br i1 %sinks, label %fall, label %stay
rise:
  %can_rise = fcmp ogt double %up, 0.0
  %up_divisor = select i1 %can_rise, double %up, double 1.0
  %rise_by = fdiv double %above, %up_divisor
  %risen = fadd double %w, %rise_by
  %root_up = select i1 %can_rise, double %risen, double 0x7FF0000000000000
  %found_up = fcmp ole double %root_up, %next_up
  br i1 %found_up, label %found_above, label %walk
fall:
  %can_fall = fcmp ogt double %down, 0.0
  %down_divisor = select i1 %can_fall, double %down, double 1.0
  %fall_by = fdiv double %below, %down_divisor
  %fallen = fadd double %w, %fall_by
  %root_down = select i1 %can_fall, double %fallen, double 0xFFF0000000000000
  %found_down = fcmp oge double %root_down, %next_down
  br i1 %found_down, label %found_below, label %walk
found_above:
  ret double %root_up
found_below:
  ret double %root_down
stay:
  ret double %w
}
"""

#: Dry friction on a member at a value; at zero the greatest ``way``.
_FRICTION = """
define internal double @rubbed(double %f, double %w, double %way) alwaysinline {
  %rests = fcmp oeq double %w, 0.0
  %goes_up = fcmp ogt double %w, 0.0
  %back = fneg double %f
  %moving = select i1 %goes_up, double %back, double %f
  %resting = fmul double %way, %f
  %found = select i1 %rests, double %resting, double %moving
  ret double %found
}
"""

_ROW = """
  br label %ball
ball:
  %j = phi i64 [ 0, %entry ], [ %next, %pushed ]
  %blocks_before = phi i64 [ 0, %entry ], [ %blocks, %pushed ]
  %next = add i64 %j, 1
  %own_at = getelementptr double, ptr %input0, i64 %j
  %own = load double, ptr %own_at
  %alone = call double @block(ptr %input0, ptr %input1, ptr %input2, ptr %input3, i64 %j, i64 %next, double %own)
  br label %merge
merge:
  %start = phi i64 [ %j, %ball ], [ %start_before, %pooled ]
  %w = phi double [ %alone, %ball ], [ %common, %pooled ]
  %count = phi i64 [ %blocks_before, %ball ], [ %last, %pooled ]
  %none = icmp eq i64 %count, 0
  br i1 %none, label %pushed, label %bound
bound:
  %behind = sub i64 %start, 1
  %touch_at = getelementptr double, ptr %input4, i64 %behind
  %touch = load double, ptr %touch_at
  %last = sub i64 %count, 1
  %start_at = getelementptr i64, ptr %output3, i64 %last
  %start_before = load i64, ptr %start_at
  %w_at = getelementptr double, ptr %output4, i64 %last
  %w_before = load double, ptr %w_at
  %touches = fcmp one double %touch, 0.0
  %faster = fcmp ogt double %w_before, %w
  %violates = and i1 %touches, %faster
  br i1 %violates, label %pooled, label %pushed
pooled:
  %common = call double @block(
    ptr %input0, ptr %input1, ptr %input2, ptr %input3, i64 %start_before, i64 %next, double %w_before)
  br label %merge
pushed:
  %kept_start_at = getelementptr i64, ptr %output3, i64 %count
  store i64 %start, ptr %kept_start_at
  %kept_w_at = getelementptr double, ptr %output4, i64 %count
  store double %w, ptr %kept_w_at
  %blocks = add i64 %count, 1
  %more = icmp slt i64 %next, %row_stop
  br i1 %more, label %ball, label %share
share:
  %block = phi i64 [ %blocks, %pushed ], [ %this, %shared ]
  %end = phi i64 [ %row_stop, %pushed ], [ %first, %shared ]
  %this = sub i64 %block, 1
  %first_at = getelementptr i64, ptr %output3, i64 %this
  %first = load i64, ptr %first_at
  %v_at = getelementptr double, ptr %output4, i64 %this
  %v = load double, ptr %v_at
  br label %back
back:
  %b_after = phi i64 [ %end, %share ], [ %b, %back ]
  %least = phi double [ 0.0, %share ], [ %least_next, %back ]
  %b = sub i64 %b_after, 1
  %b_own_at = getelementptr double, ptr %input0, i64 %b
  %b_slope_at = getelementptr double, ptr %input1, i64 %b
  %b_limit_at = getelementptr double, ptr %input2, i64 %b
  %b_friction_at = getelementptr double, ptr %input3, i64 %b
  %b_own = load double, ptr %b_own_at
  %b_slope = load double, ptr %b_slope_at
  %b_limit = load double, ptr %b_limit_at
  %b_friction = load double, ptr %b_friction_at
  %b_difference = fsub double %b_own, %v
  %b_linear = fmul double %b_slope, %b_difference
  %b_lowest = fneg double %b_limit
  %b_under = fcmp olt double %b_linear, %b_lowest
  %b_raised = select i1 %b_under, double %b_lowest, double %b_linear
  %b_over = fcmp ogt double %b_raised, %b_limit
  %b_cut = select i1 %b_over, double %b_limit, double %b_raised
  %b_pulls = fcmp ogt double %b_slope, 0.0
  %b_pull = select i1 %b_pulls, double %b_cut, double 0.0
  %drive_at = getelementptr double, ptr %output2, i64 %b
  store double %b_pull, ptr %drive_at
  %least_at = getelementptr double, ptr %output1, i64 %b
  store double %least, ptr %least_at
  %speed_at = getelementptr double, ptr %output0, i64 %b
  store double %v, ptr %speed_at
  %b_rubbed = call double @rubbed(double %b_friction, double %v, double 1.0)
  %without_pull = fsub double %least, %b_pull
  %without_both = fsub double %without_pull, %b_rubbed
  %needs = fcmp ogt double %without_both, 0.0
  %least_next = select i1 %needs, double %without_both, double 0.0
  %more_back = icmp sgt i64 %b, %first
  br i1 %more_back, label %back, label %forward
forward:
  %a = phi i64 [ %first, %back ], [ %a_next, %push ]
  %force = phi double [ 0.0, %back ], [ %force_next, %push ]
  %a_next = add i64 %a, 1
  %is_last = icmp eq i64 %a_next, %end
  br i1 %is_last, label %shared, label %push
push:
  %a_friction_at = getelementptr double, ptr %input3, i64 %a
  %a_friction = load double, ptr %a_friction_at
  %a_drive_at = getelementptr double, ptr %output2, i64 %a
  %a_drive = load double, ptr %a_drive_at
  %a_least_at = getelementptr double, ptr %output1, i64 %a
  %a_least = load double, ptr %a_least_at
  %a_rubbed = call double @rubbed(double %a_friction, double %v, double -1.0)
  %driven_on = fadd double %force, %a_drive
  %handed_on = fadd double %driven_on, %a_rubbed
  %too_little = fcmp olt double %handed_on, %a_least
  %force_next = select i1 %too_little, double %a_least, double %handed_on
  store double %force_next, ptr %a_least_at
  br label %forward
shared:
  %last_at = getelementptr double, ptr %output1, i64 %a
  store double 0.0, ptr %last_at
  %all_shared = icmp eq i64 %this, 0
  br i1 %all_shared, label %done, label %share
done:
  ret void
}
"""


_SOURCES: list[Source] = ["rows"] * INPUTS


@functools.cache
def _kernel() -> Kernel:
    head = [f"define void @kernel({SIGNATURE}) {{", "entry:", *pointers("input", INPUTS), *pointers("output", OUTPUTS)]
    return Kernel.of("\n".join([_BLOCK, _FRICTION, *head]) + _ROW, _SOURCES)


def pooled_row(row: Field) -> Field:
    """Values of the members of a row, forces between each and the next one, and pulls: the rows of an array.

    Those of the array that is given are the inputs, as :data:`INPUTS` lists them.
    """
    given = np.ascontiguousarray(row)
    values = np.empty((OUTPUTS, given.shape[1]))
    _kernel().at_addresses(slice(0, given.shape[1]), slice(0, 1), 1, 1, list(given), list(values))
    return values[:3]
