/* @TITLE@. SI units; README.txt has the rest. */
#ifndef BALLSCREW_H
#define BALLSCREW_H

#ifdef __cplusplus
extern "C" {
#endif

/* The places of the inputs and of the outputs. */
enum {
@INPUTS@
    BALLSCREW_INPUT_COUNT = @INPUT_COUNT@
};
enum {
@OUTPUTS@
    BALLSCREW_OUTPUT_COUNT = @OUTPUT_COUNT@
};

/* Names in the order of the places, and NULL at the end. */
extern const char *const ballscrew_inputs[];
extern const char *const ballscrew_outputs[];

/* The usual value of each input, and its range: beyond it the nearest value counts, and valid is 0. */
extern const double ballscrew_usual[];
extern const double ballscrew_least[];
extern const double ballscrew_greatest[];

/* Evaluates the model at one point. It keeps nothing between calls, and may be called from several threads. */
void ballscrew_evaluate(const double *inputs, double *outputs);

#ifdef __cplusplus
}
#endif

#endif
