/* Lists of steps, read and run. */
#include "ballscrew_list.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WORDS_OF_A_STEP = 5, OPERATIONS = 43, MOST_PLACES = 65536 };

const unsigned char *ballscrew_bytes(source *s, size_t n)
{
    const unsigned char *const at = s->at;
    if (n > s->left) {
        s->is_sound = 0;
        return NULL;
    }
    s->at += n;
    s->left -= n;
    return at;
}

size_t ballscrew_count(source *s, size_t most)
{
    const unsigned char *const at = ballscrew_bytes(s, 4);
    size_t n = 0;
    if (at != NULL)
        n = (size_t)at[0] | (size_t)at[1] << 8 | (size_t)at[2] << 16 | (size_t)at[3] << 24;
    if (n > most) {
        s->is_sound = 0;
        return 0;
    }
    return n;
}

void ballscrew_numbers(source *s, double *to, size_t n)
{
    const unsigned char *at = n <= s->left / 8 ? ballscrew_bytes(s, 8 * n) : ballscrew_bytes(s, s->left + 1);
    size_t i;
    int k;
    for (i = 0; at != NULL && to != NULL && i < n; i++, at += 8) {
        uint64_t bits = 0;
        for (k = 7; k >= 0; k--)
            bits = bits << 8 | at[k];
        memcpy(&to[i], &bits, sizeof to[i]);
    }
}

static void words(source *s, uint16_t *to, size_t n)
{
    const unsigned char *at = n <= s->left / 2 ? ballscrew_bytes(s, 2 * n) : ballscrew_bytes(s, s->left + 1);
    size_t i;
    for (i = 0; at != NULL && to != NULL && i < n; i++, at += 2)
        to[i] = (uint16_t)(at[0] | at[1] << 8);
}

/* For one thing where there are none. */
void *ballscrew_room(source *s, size_t n, size_t size)
{
    void *const room = calloc(n > 0 ? n : 1, size);
    s->is_sound = s->is_sound && room != NULL;
    return room;
}

void ballscrew_list_read(source *s, list *l)
{
    size_t constants, further, places, i, k;
    l->inputs = ballscrew_count(s, MOST_PLACES);
    l->outputs = ballscrew_count(s, MOST_PLACES);
    constants = ballscrew_count(s, MOST_PLACES);
    further = ballscrew_count(s, MOST_PLACES);
    l->steps = ballscrew_count(s, s->left);
    places = l->inputs + constants + further;
    if (!s->is_sound || places > MOST_PLACES || l->steps > s->left / (2 * WORDS_OF_A_STEP)) {
        s->is_sound = 0;
        return;
    }
    l->v = ballscrew_room(s, places, sizeof *l->v);
    l->places = ballscrew_room(s, l->outputs, sizeof *l->places);
    l->code = ballscrew_room(s, WORDS_OF_A_STEP * l->steps, sizeof *l->code);
    if (!s->is_sound)
        return;
    ballscrew_numbers(s, l->v + l->inputs, constants);
    words(s, l->places, l->outputs);
    words(s, l->code, WORDS_OF_A_STEP * l->steps);
    for (i = 0; i < l->outputs; i++)
        s->is_sound = s->is_sound && l->places[i] < places;
    for (k = 0; k < l->steps; k++) {
        const uint16_t *const step = l->code + WORDS_OF_A_STEP * k;
        s->is_sound = s->is_sound && step[0] < OPERATIONS && step[4] >= l->inputs + constants;
        for (i = 1; i < WORDS_OF_A_STEP; i++)
            s->is_sound = s->is_sound && step[i] < places;
    }
}

void ballscrew_list_free(list *l)
{
    free(l->v);
    free(l->places);
    free(l->code);
}

/* As Python has it: with the sign of b. */
static double remainder_of(double a, double b)
{
    const double m = fmod(a, b);
    return m == 0.0 ? copysign(0.0, b) : (b < 0.0) != (m < 0.0) ? m + b : m;
}

void ballscrew_list_run(const list *l)
{
    double *const v = l->v;
    const uint16_t *code = l->code, *const end = code + WORDS_OF_A_STEP * l->steps;
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
