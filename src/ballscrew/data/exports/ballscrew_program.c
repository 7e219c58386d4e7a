/* The interpreter of a model as data.

   The file, all numbers with the least byte first: the letters BSCREW02; four counts of four bytes: inputs, outputs,
   bytes of names, levels; the names of inputs and outputs, each with a zero behind it; for each input its usual value,
   then for each the least, then for each the greatest one, of eight bytes each. Then comes the model.

   A model of one level is a list of steps from the inputs to the outputs. One of two levels is a nut with elastic
   bodies: how many inputs its lists read, and which; the place of the preload among the inputs and one, or zero; the
   place of what the solver of the loads leaves; how many values a ball reads, of each whether it is one of its own, and
   which; how many reductions over the balls, of each its kind (sum, greatest, place of the greatest, value at a place),
   of which value of a ball, and the reduction with the place; the numbers of the nut; the lists of points, of balls, and
   behind the reductions. All of these are numbers of four bytes, those of the nut from the fifth on of eight.

   A list of steps is described in ballscrew_list.h. The last output is "valid". */
#include "ballscrew_program.h"

#include "ballscrew_list.h"
#include "ballscrew_loads.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ARRAYS_OF_BALLS = 4, MOST_BALLS = 100000, LARGEST_FILE = 64 * 1024 * 1024 };
enum { SUM, GREATEST, PLACE, AT_PLACE, KINDS_OF_REDUCTIONS };

struct ballscrew_program {
    size_t inputs, outputs, levels;
    char *text;
    const char **input_names, **output_names;
    double *usual, *least, *greatest;
    list lists[3]; /* of points, of balls, and behind; or the first alone */
    ballscrew_nut nut;
    size_t read, preload, solved, tables, reductions;
    size_t *inputs_read, *table, *reduction;
    double *room, *balls, *given;
};

static void read_nut(source *s, ballscrew_nut *nut)
{
    double v[9] = {0.0};
    nut->halves = (int)ballscrew_count(s, 2);
    nut->balls = (int)ballscrew_count(s, MOST_BALLS);
    nut->four_contacts = (int)ballscrew_count(s, 1);
    nut->swells = (int)ballscrew_count(s, 1);
    ballscrew_numbers(s, v, 9);
    nut->load_deflection = v[0];
    nut->centre_distance = v[1];
    nut->contact_angle = v[2];
    nut->lead_cosine = v[3];
    nut->step = v[4];
    nut->spacing = v[5];
    nut->link = v[6];
    nut->first_share = v[7];
    nut->radial_stiffness = v[8];
    s->is_sound = s->is_sound && nut->halves > 0 && nut->balls > 0;
}

static void read_two_levels(source *s, ballscrew_program *p)
{
    size_t i, all;
    p->read = ballscrew_count(s, p->inputs);
    p->inputs_read = ballscrew_room(s, p->read, sizeof *p->inputs_read);
    for (i = 0; s->is_sound && i < p->read; i++)
        p->inputs_read[i] = ballscrew_count(s, p->inputs - 1);
    p->preload = ballscrew_count(s, p->inputs);
    p->solved = ballscrew_count(s, 65536);
    p->tables = ballscrew_count(s, 65536);
    p->table = ballscrew_room(s, 2 * p->tables, sizeof *p->table);
    for (i = 0; s->is_sound && i < 2 * p->tables; i++)
        p->table[i] = ballscrew_count(s, 65536);
    p->reductions = ballscrew_count(s, 65536);
    p->reduction = ballscrew_room(s, 3 * p->reductions, sizeof *p->reduction);
    for (i = 0; s->is_sound && i < 3 * p->reductions; i++)
        p->reduction[i] = ballscrew_count(s, 65536);
    read_nut(s, &p->nut);
    for (i = 0; i < 3 && s->is_sound; i++)
        ballscrew_list_read(s, &p->lists[i]);
    if (!s->is_sound)
        return;
    for (i = 0; i < p->tables; i++)
        s->is_sound = s->is_sound && p->table[2 * i] < 2
            && p->table[2 * i + 1] < (p->table[2 * i] ? ARRAYS_OF_BALLS : p->lists[0].outputs);
    for (i = 0; i < p->reductions; i++)
        s->is_sound = s->is_sound && p->reduction[3 * i] < KINDS_OF_REDUCTIONS
            && p->reduction[3 * i + 1] < p->lists[1].outputs && p->reduction[3 * i + 2] < p->reductions;
    s->is_sound = s->is_sound && p->lists[1].inputs == p->tables && p->solved < p->lists[0].inputs
        && p->read <= p->lists[0].inputs && p->lists[2].inputs == p->lists[0].inputs + p->reductions;
    all = (size_t)p->nut.halves * (size_t)p->nut.balls;
    p->room = ballscrew_room(s, BALLSCREW_LOADS_ROOM(all), sizeof *p->room);
    p->balls = ballscrew_room(s, BALLSCREW_LOADS_SIZE(all), sizeof *p->balls);
    p->given = ballscrew_room(s, p->inputs, sizeof *p->given);
}

static void read_names(source *s, ballscrew_program *p, size_t size)
{
    const unsigned char *const text = ballscrew_bytes(s, size);
    char *at, *end;
    size_t i;
    p->text = ballscrew_room(s, size, 1);
    p->input_names = ballscrew_room(s, p->inputs + 1, sizeof *p->input_names);
    p->output_names = ballscrew_room(s, p->outputs + 1, sizeof *p->output_names);
    if (!s->is_sound)
        return;
    memcpy(p->text, text, size);
    at = p->text;
    end = at + size;
    for (i = 0; i < p->inputs + p->outputs; i++) {
        char *const stop = at < end ? memchr(at, 0, (size_t)(end - at)) : NULL;
        if (stop == NULL) {
            s->is_sound = 0;
            return;
        }
        *(i < p->inputs ? &p->input_names[i] : &p->output_names[i - p->inputs]) = at;
        at = stop + 1;
    }
}

ballscrew_program *ballscrew_program_of(const unsigned char *bytes, size_t size)
{
    source s = {bytes, size, 1};
    ballscrew_program *const p = calloc(1, sizeof *p);
    const unsigned char *const letters = ballscrew_bytes(&s, 8);
    size_t size_of_names;
    if (p == NULL || letters == NULL || memcmp(letters, "BSCREW02", 8) != 0) {
        free(p);
        return NULL;
    }
    p->inputs = ballscrew_count(&s, 65536);
    p->outputs = ballscrew_count(&s, 65536);
    size_of_names = ballscrew_count(&s, LARGEST_FILE);
    p->levels = ballscrew_count(&s, 2);
    read_names(&s, p, size_of_names);
    p->usual = ballscrew_room(&s, 3 * p->inputs, sizeof *p->usual);
    ballscrew_numbers(&s, p->usual, 3 * p->inputs);
    s.is_sound = s.is_sound && p->inputs > 0 && p->outputs > 0 && p->levels > 0;
    if (s.is_sound) {
        p->least = p->usual + p->inputs;
        p->greatest = p->least + p->inputs;
        if (p->levels == 1)
            ballscrew_list_read(&s, &p->lists[0]);
        else
            read_two_levels(&s, p);
    }
    if (!s.is_sound || s.left > 0 || p->lists[p->levels == 1 ? 0 : 2].outputs != p->outputs
        || (p->levels == 1 && p->lists[0].inputs != p->inputs)) {
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
    int i;
    if (p == NULL)
        return;
    for (i = 0; i < 3; i++)
        ballscrew_list_free(&p->lists[i]);
    free(p->text);
    free(p->input_names);
    free(p->output_names);
    free(p->usual);
    free(p->inputs_read);
    free(p->table);
    free(p->reduction);
    free(p->room);
    free(p->balls);
    free(p->given);
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

/* The value of an output after a run. */
static double output(const list *l, size_t k)
{
    return l->v[l->places[k]];
}

/* Takes the values of a ball into the reductions, the last inputs of the last list. */
static void reduce(const ballscrew_program *p, int is_first)
{
    double *const r = p->lists[2].v + p->lists[0].inputs;
    size_t k, j;
    for (k = 0; k < p->reductions; k++) {
        const size_t *const one = p->reduction + 3 * k;
        const double value = output(&p->lists[1], one[1]);
        if (one[0] == SUM)
            r[k] = is_first ? value : r[k] + value;
        else if (one[0] == GREATEST)
            r[k] = is_first || value > r[k] || value != value ? value : r[k];
        else if (one[0] == PLACE && (is_first || value > r[k])) {
            r[k] = value;
            for (j = 0; j < p->reductions; j++)
                if (p->reduction[3 * j] == AT_PLACE && p->reduction[3 * j + 2] == k)
                    r[j] = output(&p->lists[1], p->reduction[3 * j + 1]);
        }
    }
}

static void evaluate_two_levels(ballscrew_program *p, const double *x)
{
    list *const points = &p->lists[0], *const ball = &p->lists[1], *const behind = &p->lists[2];
    const size_t all = (size_t)p->nut.halves * (size_t)p->nut.balls;
    size_t i, k;
    for (k = 0; k < p->read; k++)
        points->v[k] = x[p->inputs_read[k]];
    points->v[p->solved] = ballscrew_loads(&p->nut, x[0], p->preload ? x[p->preload - 1] : 0.0, p->room, p->balls);
    ballscrew_list_run(points);
    for (k = 0; k < p->tables; k++)
        if (!p->table[2 * k])
            ball->v[k] = output(points, p->table[2 * k + 1]);
    for (i = 0; i < all; i++) {
        for (k = 0; k < p->tables; k++)
            if (p->table[2 * k])
                ball->v[k] = p->balls[p->table[2 * k + 1] * all + i];
        ballscrew_list_run(ball);
        reduce(p, i == 0);
    }
    memcpy(behind->v, points->v, points->inputs * sizeof *behind->v);
    ballscrew_list_run(behind);
}

void ballscrew_program_evaluate(ballscrew_program *p, const double *inputs, double *outputs)
{
    const list *const last = &p->lists[p->levels == 1 ? 0 : 2];
    double *const x = p->levels == 1 ? p->lists[0].v : p->given;
    int inside = 1;
    size_t i;
    for (i = 0; i < p->inputs; i++) {
        const double least = p->least[i], greatest = p->greatest[i], given = inputs[i];
        inside = inside && given >= least && given <= greatest;
        x[i] = given < least ? least : given > greatest ? greatest : given;
    }
    if (p->levels == 1)
        ballscrew_list_run(&p->lists[0]);
    else
        evaluate_two_levels(p, x);
    for (i = 0; i < p->outputs; i++)
        outputs[i] = output(last, i);
    outputs[p->outputs - 1] = inside && outputs[p->outputs - 1] != 0.0;
}
