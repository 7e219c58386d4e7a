/* The loads of the balls of a nut at many points, for the static page: arrays in, arrays out. */
#include "ballscrew_loads.h"

enum { NUMBERS = 9, LOAD = NUMBERS, PRELOAD, STATE = 3 };

/* Inputs are the numbers of a nut in the order of its structure, the load and the preload, an array over the points each.
   Outputs are loads forwards and backwards and the angles of both, a row of points for each ball, then the three numbers of
   the state, and the residual. The room is for sixteen numbers a ball. */
void loads(int count, int halves, int balls, int four_contacts, int swells, double *const *inputs,
           double *const *outputs, double *room)
{
    const int all = halves * balls;
    double *const found = room, *const work = room + BALLSCREW_LOADS_SIZE(all);
    int p, i, k;
    for (p = 0; p < count; p++) {
        ballscrew_nut nut = {0};
        double state[STATE];
        nut.halves = halves;
        nut.balls = balls;
        nut.four_contacts = four_contacts;
        nut.swells = swells;
        nut.load_deflection = inputs[0][p];
        nut.centre_distance = inputs[1][p];
        nut.contact_angle = inputs[2][p];
        nut.lead_cosine = inputs[3][p];
        nut.step = inputs[4][p];
        nut.spacing = inputs[5][p];
        nut.link = inputs[6][p];
        nut.first_share = inputs[7][p];
        nut.radial_stiffness = inputs[8][p];
        outputs[4 + STATE][p] =
            ballscrew_loads_and_state(&nut, inputs[LOAD][p], inputs[PRELOAD][p], work, found, state);
        for (k = 0; k < 4; k++)
            for (i = 0; i < all; i++)
                outputs[k][i * count + p] = found[k * all + i];
        for (k = 0; k < STATE; k++)
            outputs[4 + k][p] = state[k];
    }
}
