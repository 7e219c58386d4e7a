"""The records of questions, of which faces make commands and addresses."""

from __future__ import annotations

from ballscrew.questions.axis.question import QUESTION as AXIS
from ballscrew.questions.compare_designs.question import QUESTION as COMPARE
from ballscrew.questions.condition.question import QUESTION as CONDITION
from ballscrew.questions.duty.question import QUESTION as DUTY
from ballscrew.questions.optimise.question import QUESTION as OPTIMISE
from ballscrew.questions.reversal.question import QUESTION as REVERSAL
from ballscrew.questions.ripple.question import QUESTION as RIPPLE
from ballscrew.questions.select.question import QUESTION as SELECT
from ballscrew.questions.sensitivity.question import QUESTION as SENSITIVITY
from ballscrew.questions.service.question import QUESTION as SERVICE
from ballscrew.questions.warm_up.question import QUESTION as WARM_UP

QUESTIONS = (AXIS, COMPARE, CONDITION, DUTY, OPTIMISE, REVERSAL, RIPPLE, SELECT, SENSITIVITY, SERVICE, WARM_UP)
