/* A list of steps: how it is read from a file, and run. C99 and libm only.

   In the file: the counts of inputs, outputs, constants, further places and steps; the constants, of eight bytes;
   the place of each output, of two bytes; the steps, each an operation, three operands and a result, of two bytes.
   Places are numbered over inputs, constants and further places. Truth values are 1 and 0.

   Do not compile with -ffast-math: limits at rest and without load need infinities and numbers that are none. */
#ifndef BALLSCREW_LIST_H
#define BALLSCREW_LIST_H

#include <stddef.h>
#include <stdint.h>

/* What is left of a file; nothing is read beyond its end. */
typedef struct {
    const unsigned char *at;
    size_t left;
    int is_sound;
} source;

/* The next bytes, numbers, or new room; where they are not there, or a count is larger than it may be, is_sound is 0. */
const unsigned char *ballscrew_bytes(source *s, size_t n);
size_t ballscrew_count(source *s, size_t most);
void ballscrew_numbers(source *s, double *to, size_t n);
void *ballscrew_room(source *s, size_t n, size_t size);

/* A list of steps, with room for its values: inputs, constants and further places. */
typedef struct {
    size_t inputs, outputs, steps;
    double *v;
    uint16_t *places, *code;
} list;

void ballscrew_list_read(source *s, list *l);
void ballscrew_list_free(list *l);
void ballscrew_list_run(const list *l);

#endif
