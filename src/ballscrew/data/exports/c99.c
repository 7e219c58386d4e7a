/* @TITLE@. Made by ballscrew @VERSION@; README.txt says of what.
   Do not compile with -ffast-math: limits at rest and without load need infinities and numbers that are none. */
#include "ballscrew.h"

#include <math.h>
#include <stddef.h>

const char *const ballscrew_inputs[] = {@INPUTS@, NULL};
const char *const ballscrew_outputs[] = {@OUTPUTS@, NULL};
const double ballscrew_usual[] = {@USUAL@};
const double ballscrew_least[] = {@LEAST@};
const double ballscrew_greatest[] = {@GREATEST@};

@FUNCTIONS@

void ballscrew_evaluate(const double *inputs, double *outputs)
{
    double x[BALLSCREW_INPUT_COUNT];
    int inside = 1;
    int i;
    for (i = 0; i < BALLSCREW_INPUT_COUNT; i++) {
        const double least = ballscrew_least[i], greatest = ballscrew_greatest[i], given = inputs[i];
        inside = inside && given >= least && given <= greatest;
        x[i] = given < least ? least : given > greatest ? greatest : given;
    }
@STATEMENTS@
@RESULTS@
}
