/* An example, and the test of the vector: cc -std=c99 -O2 ballscrew.c main.c -lm && ./a.out test_vector.csv */
#include "ballscrew.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static int tested(const char *path)
{
    double inputs[BALLSCREW_INPUT_COUNT], outputs[BALLSCREW_OUTPUT_COUNT], worst = 0.0;
    char line[8192];
    int rows = 0;
    FILE *file = fopen(path, "r");
    if (file == NULL || fgets(line, sizeof line, file) == NULL) {
        fprintf(stderr, "%s: cannot be read\n", path);
        return 2;
    }
    while (fgets(line, sizeof line, file) != NULL) {
        char *at = line;
        int i;
        for (i = 0; i < BALLSCREW_INPUT_COUNT; i++, at++)
            inputs[i] = strtod(at, &at);
        ballscrew_evaluate(inputs, outputs);
        for (i = 0; i < BALLSCREW_OUTPUT_COUNT; i++, at++) {
            const double wanted = strtod(at, &at), found = outputs[i];
            const double off = fabs(found - wanted) / (fabs(wanted) > 0.0 ? fabs(wanted) : 1.0);
            if (isnan(found) != isnan(wanted) || off > worst)
                worst = isnan(found) != isnan(wanted) ? HUGE_VAL : off;
        }
        rows++;
    }
    fclose(file);
    printf("%d rows, largest relative difference %.2g\n", rows, worst);
    return worst <= 1e-9 ? 0 : 1;
}

int main(int count, char **arguments)
{
    double inputs[BALLSCREW_INPUT_COUNT], outputs[BALLSCREW_OUTPUT_COUNT];
    int i;
    if (count > 1)
        return tested(arguments[1]);
    for (i = 0; i < BALLSCREW_INPUT_COUNT; i++)
        inputs[i] = ballscrew_usual[i];
    inputs[BALLSCREW_AXIAL_LOAD] = @LOAD@;
    inputs[BALLSCREW_SCREW_SPEED] = @SPEED@;
    ballscrew_evaluate(inputs, outputs);
    for (i = 0; i < BALLSCREW_INPUT_COUNT; i++)
        printf("%s = %.9g\n", ballscrew_inputs[i], inputs[i]);
    for (i = 0; i < BALLSCREW_OUTPUT_COUNT; i++)
        printf("%s = %.9g\n", ballscrew_outputs[i], outputs[i]);
    return 0;
}
