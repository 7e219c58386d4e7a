/* The interpreter of a model as data.

   The file, all numbers with the least byte first: the letters BSCREW01; the numbers (4 bytes each) of inputs, outputs,
   constants, further places, steps, and bytes of names; the names of inputs and outputs, each with a zero behind it;
   for each input its usual value, then for each the least, then for each the greatest one (8 bytes each); the constants;
   the place of each output (2 bytes each); the steps, each an operation, three operands and a result (2 bytes each).
   Places are numbered over inputs, constants and further places. Truth values are 1 and 0. The last output is "valid".

   Do not compile with -ffast-math: limits at rest and without load need infinities and numbers that are none. */
#include "ballscrew_program.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAGIC = 8, COUNTS = 6, WORDS_OF_A_STEP = 5, OPERATIONS = 43, LARGEST_FILE = 64 * 1024 * 1024 };

struct ballscrew_program {
    size_t inputs, outputs, steps;
    char *text;
    const char **input_names, **output_names;
    double *usual, *least, *greatest;
    double *v;
    uint16_t *places, *code;
};

static uint16_t word(const unsigned char *at)
{
    return (uint16_t)(at[0] | at[1] << 8);
}

static size_t count(const unsigned char *at)
{
    return (size_t)at[0] | (size_t)at[1] << 8 | (size_t)at[2] << 16 | (size_t)at[3] << 24;
}

static double number(const unsigned char *at)
{
    uint64_t bits = 0;
    double found;
    int i;
    for (i = 7; i >= 0; i--)
        bits = bits << 8 | at[i];
    memcpy(&found, &bits, sizeof found);
    return found;
}

static const unsigned char *numbers(const unsigned char *at, double *to, size_t n)
{
    size_t i;
    for (i = 0; i < n; i++, at += 8)
        to[i] = number(at);
    return at;
}

static int words(const unsigned char *at, uint16_t *to, size_t n, size_t places)
{
    size_t i;
    int inside = 1;
    for (i = 0; i < n; i++) {
        to[i] = word(at + 2 * i);
        inside = inside && to[i] < places;
    }
    return inside;
}

static int steps_are_sound(const uint16_t *code, size_t steps, size_t first, size_t places)
{
    size_t k, i;
    for (k = 0; k < steps; k++, code += WORDS_OF_A_STEP) {
        if (code[0] >= OPERATIONS || code[4] < first)
            return 0;
        for (i = 1; i < WORDS_OF_A_STEP; i++)
            if (code[i] >= places)
                return 0;
    }
    return 1;
}

static int names_of(ballscrew_program *p, size_t size)
{
    char *at = p->text, *const end = p->text + size;
    size_t i;
    for (i = 0; i < p->inputs + p->outputs; i++) {
        char *const stop = at < end ? memchr(at, 0, (size_t)(end - at)) : NULL;
        if (stop == NULL)
            return 0;
        *(i < p->inputs ? &p->input_names[i] : &p->output_names[i - p->inputs]) = at;
        at = stop + 1;
    }
    return 1;
}

ballscrew_program *ballscrew_program_of(const unsigned char *bytes, size_t size)
{
    size_t n[COUNTS], i, places, wanted;
    const unsigned char *at = bytes + MAGIC + 4 * COUNTS;
    ballscrew_program *p;
    if (size < MAGIC + 4 * COUNTS || size > LARGEST_FILE || memcmp(bytes, "BSCREW01", MAGIC) != 0)
        return NULL;
    for (i = 0; i < COUNTS; i++) {
        n[i] = count(bytes + MAGIC + 4 * i);
        if (n[i] > size)
            return NULL;
    }
    places = n[0] + n[2] + n[3];
    wanted = MAGIC + 4 * COUNTS + n[5] + 8 * (3 * n[0] + n[2]) + 2 * (n[1] + WORDS_OF_A_STEP * n[4]);
    if (size != wanted || n[0] == 0 || n[1] == 0 || places > 65536)
        return NULL;
    p = calloc(1, sizeof *p);
    if (p == NULL)
        return NULL;
    p->inputs = n[0];
    p->outputs = n[1];
    p->steps = n[4];
    p->text = malloc(n[5] + 1);
    p->input_names = calloc(n[0] + 1, sizeof *p->input_names);
    p->output_names = calloc(n[1] + 1, sizeof *p->output_names);
    p->usual = malloc(3 * n[0] * sizeof *p->usual);
    p->v = calloc(places, sizeof *p->v);
    p->places = malloc(n[1] * sizeof *p->places);
    p->code = malloc((WORDS_OF_A_STEP * n[4] + 1) * sizeof *p->code);
    if (!p->text || !p->input_names || !p->output_names || !p->usual || !p->v || !p->places || !p->code) {
        ballscrew_program_free(p);
        return NULL;
    }
    memcpy(p->text, at, n[5]);
    p->least = p->usual + n[0];
    p->greatest = p->least + n[0];
    at = numbers(at + n[5], p->usual, 3 * n[0]);
    at = numbers(at, p->v + n[0], n[2]);
    if (!names_of(p, n[5]) || !words(at, p->places, n[1], places)
        || !words(at + 2 * n[1], p->code, WORDS_OF_A_STEP * n[4], 65536)
        || !steps_are_sound(p->code, n[4], n[0] + n[2], places)) {
        ballscrew_program_free(p);
        return NULL;
    }
    return p;
}

ballscrew_program *ballscrew_program_read(const char *path)
{
    ballscrew_program *found = NULL;
    unsigned char *bytes;
    long size;
    FILE *file = fopen(path, "rb");
    if (file == NULL)
        return NULL;
    if (fseek(file, 0, SEEK_END) == 0 && (size = ftell(file)) > 0 && size <= LARGEST_FILE) {
        bytes = malloc((size_t)size);
        rewind(file);
        if (bytes != NULL && fread(bytes, 1, (size_t)size, file) == (size_t)size)
            found = ballscrew_program_of(bytes, (size_t)size);
        free(bytes);
    }
    fclose(file);
    return found;
}

void ballscrew_program_free(ballscrew_program *p)
{
    if (p == NULL)
        return;
    free(p->text);
    free(p->input_names);
    free(p->output_names);
    free(p->usual);
    free(p->v);
    free(p->places);
    free(p->code);
    free(p);
}

const char *const *ballscrew_program_inputs(const ballscrew_program *p)
{
    return p->input_names;
}

const char *const *ballscrew_program_outputs(const ballscrew_program *p)
{
    return p->output_names;
}

const double *ballscrew_program_usual(const ballscrew_program *p)
{
    return p->usual;
}

/* As Python has it: with the sign of b. */
static double remainder_of(double a, double b)
{
    const double m = fmod(a, b);
    return m == 0.0 ? copysign(0.0, b) : (b < 0.0) != (m < 0.0) ? m + b : m;
}

static void run(double *v, const uint16_t *code, const uint16_t *end)
{
    for (; code != end; code += WORDS_OF_A_STEP) {
        const double a = v[code[1]], b = v[code[2]];
        double r = 0.0;
        switch (code[0]) {
        case 0: r = a + b; break;
        case 1: r = a - b; break;
        case 2: r = a * b; break;
        case 3: r = a / b; break;
        case 4: r = a != 0.0 ? b : v[code[3]]; break;
        case 5: r = sqrt(a); break;
        case 6: r = a < b || a != a ? a : b; break;
        case 7: r = a > b || a != a ? a : b; break;
        case 8: r = exp(a); break;
        case 9: r = log(a); break;
        case 10: r = pow(a, b); break;
        case 11: r = fabs(a); break;
        case 12: r = a > b; break;
        case 13: r = a >= b; break;
        case 14: r = a < b; break;
        case 15: r = a <= b; break;
        case 16: r = a == b; break;
        case 17: r = a != b; break;
        case 18: r = a != 0.0 && b != 0.0; break;
        case 19: r = a != 0.0 || b != 0.0; break;
        case 20: r = (a != 0.0) != (b != 0.0); break;
        case 21: r = a == 0.0; break;
        case 22: r = isfinite(a) ? 1.0 : 0.0; break;
        case 23: r = isnan(a) ? 1.0 : 0.0; break;
        case 24: r = isinf(a) ? 1.0 : 0.0; break;
        case 25: r = sin(a); break;
        case 26: r = cos(a); break;
        case 27: r = tan(a); break;
        case 28: r = asin(a); break;
        case 29: r = acos(a); break;
        case 30: r = atan(a); break;
        case 31: r = atan2(a, b); break;
        case 32: r = sinh(a); break;
        case 33: r = cosh(a); break;
        case 34: r = tanh(a); break;
        case 35: r = asinh(a); break;
        case 36: r = expm1(a); break;
        case 37: r = log1p(a); break;
        case 38: r = floor(a); break;
        case 39: r = ceil(a); break;
        case 40: r = cbrt(a); break;
        case 41: r = hypot(a, b); break;
        case 42: r = remainder_of(a, b); break;
        default: break;
        }
        v[code[4]] = r;
    }
}

void ballscrew_program_evaluate(ballscrew_program *p, const double *inputs, double *outputs)
{
    int inside = 1;
    size_t i;
    for (i = 0; i < p->inputs; i++) {
        const double least = p->least[i], greatest = p->greatest[i], given = inputs[i];
        inside = inside && given >= least && given <= greatest;
        p->v[i] = given < least ? least : given > greatest ? greatest : given;
    }
    run(p->v, p->code, p->code + WORDS_OF_A_STEP * p->steps);
    for (i = 0; i < p->outputs; i++)
        outputs[i] = p->v[p->places[i]];
    outputs[p->outputs - 1] = inside && outputs[p->outputs - 1] != 0.0;
}
