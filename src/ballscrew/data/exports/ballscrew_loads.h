/* The loads of the balls of a nut whose bodies are elastic, as src/ballscrew/solvers has them. C99 and libm only. */
#ifndef BALLSCREW_LOADS_H
#define BALLSCREW_LOADS_H

/* What does not change: SI units. */
typedef struct {
    int halves, balls;      /* bodies of the nut that brace each other, 1 or 2, and the balls of each */
    int four_contacts;      /* oversize balls touch both flanks */
    int swells;             /* balls widen the nut, and shrink the shaft */
    double load_deflection; /* of a ball between screw and nut, N/m^1.5 */
    double centre_distance, contact_angle, lead_cosine;
    double step, spacing;   /* axial distance from ball to ball, and between the halves */
    double link;            /* stiffness times length of both bodies in series, N */
    double first_share;     /* share of the load that enters at the first ball */
    double radial_stiffness;
} ballscrew_nut;

/* Numbers of work space for so many balls in all, and numbers of the result: load forwards and backwards, contact angle
   forwards and backwards, one array after the other. */
#define BALLSCREW_LOADS_ROOM(balls) (11 * (balls))
#define BALLSCREW_LOADS_SIZE(balls) (4 * (balls))

/* Solves the balls of all halves under an axial load and a preload; returns the imbalance relative to both. */
double ballscrew_loads(const ballscrew_nut *nut, double load, double preload, double *room, double *found);

/* The same, and three numbers of the nut: how far the load moves the screw against the nut, from where both are without
   load; the slope of the load by that; and the axial force of the balls that the load relieves. */
double ballscrew_loads_and_state(const ballscrew_nut *nut, double load, double preload, double *room, double *found,
                                 double *state);

#endif
