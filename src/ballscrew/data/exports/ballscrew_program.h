/* A model as data: a list of steps in a file, and the interpreter that runs it. C99 and libm only; SI units. */
#ifndef BALLSCREW_PROGRAM_H
#define BALLSCREW_PROGRAM_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(_WIN32)
#define BALLSCREW_PUBLIC __declspec(dllexport)
#elif defined(__GNUC__)
#define BALLSCREW_PUBLIC __attribute__((visibility("default")))
#else
#define BALLSCREW_PUBLIC
#endif

typedef struct ballscrew_program ballscrew_program;

/* The program in a file, or in bytes, which may go afterwards; NULL where it is damaged or there is no memory. */
BALLSCREW_PUBLIC ballscrew_program *ballscrew_program_read(const char *path);
BALLSCREW_PUBLIC ballscrew_program *ballscrew_program_of(const unsigned char *bytes, size_t size);
BALLSCREW_PUBLIC void ballscrew_program_free(ballscrew_program *program);

/* The names of inputs and outputs, NULL at the end. */
BALLSCREW_PUBLIC const char *const *ballscrew_program_inputs(const ballscrew_program *program);
BALLSCREW_PUBLIC const char *const *ballscrew_program_outputs(const ballscrew_program *program);

/* The usual value of each input. */
BALLSCREW_PUBLIC const double *ballscrew_program_usual(const ballscrew_program *program);

/* Evaluates one point. A program has room for one evaluation at a time: each thread reads its own. */
BALLSCREW_PUBLIC void ballscrew_program_evaluate(ballscrew_program *program, const double *inputs, double *outputs);

#ifdef __cplusplus
}
#endif

#endif
