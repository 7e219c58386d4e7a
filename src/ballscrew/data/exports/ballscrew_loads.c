/* Balls as springs between elastic bodies: a chain of bars, and a gap that the balls open between nut and shaft.

   The balance has one solution. It is found by Newton's method, damped, in the chain, and around it by Newton's method
   in the gaps of the bodies. Imbalances are judged against load and preload; what rounding leaves is less. */
#include "ballscrew_loads.h"

#include <math.h>

static const double BALANCED = 1e-13, ROUNDING = 1e-15, START = 0.1, PICOMETRE = 1e-12, LARGEST_OF_A_BALL = 1e-6;
static const double NOTHING = 1e-100; /* a load nearer to zero is none, as in components/operating_state.py */
enum { STEPS = 100, STEPS_OF_GAPS = 40, HALVINGS = 12 };

/* The grooves of a body as they are apart: distance of their centres, along and across the axis, and what balls are
   too big by. */
typedef struct {
    double distance, along, across, excess;
} grooves;

typedef struct {
    const ballscrew_nut *nut;
    int count, bodies;
    const double *facing, *offset, *bars;
    double excess, first_share, load, scale;
    double gap[2];
    grooves body[2];
} chain;

typedef struct {
    double load, sine, force, slope, stiffness, turning;
} flank;

typedef struct {
    double force, slope, push, push_slope, cross;
} ball;

static flank flank_of(const chain *c, const grooves *g, double facing, double offset, double x)
{
    const double K = c->nut->load_deflection, phi = c->nut->lead_cosine;
    const double xi = facing * x * phi + offset, s = sqrt(g->across * g->across + (g->along + xi) * (g->along + xi));
    const double approach = xi * (2.0 * g->along + xi) / (s + g->distance) + g->excess;
    flank f;
    double delta;
    f.sine = (g->along + xi) / s;
    delta = f.sine > 0.0 && approach > 0.0 ? approach : 0.0;
    f.load = K * delta * sqrt(delta);
    f.stiffness = 1.5 * K * sqrt(delta);
    f.turning = f.load / s;
    f.force = facing * f.load * f.sine * phi;
    f.slope = (f.stiffness * f.sine * f.sine + f.turning * (1.0 - f.sine * f.sine)) * phi * phi;
    return f;
}

static ball ball_at(const chain *c, int i, double x)
{
    const grooves *const g = &c->body[c->bodies == 2 && i >= c->count / 2];
    ball found = {0.0, 0.0, 0.0, 0.0, 0.0};
    int k;
    for (k = 0; k <= c->nut->four_contacts; k++) {
        const double facing = k == 0 ? c->facing[i] : -c->facing[i];
        const flank f = flank_of(c, g, facing, c->offset[i], x);
        const double cosine = sqrt(1.0 - f.sine * f.sine);
        found.force += f.force;
        found.slope += f.slope;
        found.push += f.load * cosine;
        found.push_slope -= f.stiffness * cosine * cosine + f.turning * f.sine * f.sine;
        found.cross += facing * c->nut->lead_cosine * (f.stiffness - f.turning) * f.sine * cosine;
    }
    return found;
}

/* Grooves that a gap has moved apart. */
static grooves widened(const chain *c, double gap)
{
    const double A = c->nut->centre_distance, alpha = c->nut->contact_angle;
    grooves g;
    g.across = A * cos(alpha) - gap;
    g.along = A * sin(alpha);
    g.distance = gap == 0.0 ? A : sqrt(g.across * g.across + g.along * g.along);
    g.excess = c->excess - gap * (2.0 * A * cos(alpha) - gap) / (A + g.distance);
    return g;
}

/* Force left at each ball, and the slope of its own; returns the root of the sum of squares. */
static double imbalance(const chain *c, const double *x, double *left, double *slope)
{
    double sum = 0.0;
    int i;
    for (i = 0; i < c->count; i++) {
        const ball b = ball_at(c, i, x[i]);
        left[i] = -b.force;
        slope[i] = b.slope;
    }
    left[0] += c->first_share * c->load;
    left[c->count - 1] += (1.0 - c->first_share) * c->load;
    for (i = 0; i + 1 < c->count; i++) {
        const double passed_on = c->bars[i] * (x[i + 1] - x[i]);
        left[i] += passed_on;
        left[i + 1] -= passed_on;
    }
    for (i = 0; i < c->count; i++)
        sum += left[i] * left[i];
    return sqrt(sum);
}

static double rounding(const chain *c, const double *x)
{
    double most = 0.0;
    int i;
    for (i = 0; i + 1 < c->count; i++)
        most = fmax(most, c->bars[i] * fabs(x[i + 1]));
    return ROUNDING * sqrt((double)c->count) * most;
}

/* Displacements of a chain of linear springs under forces: sums of what is not negative, so that stiff bars cost no
   digits. The work space may be neither. */
static void tridiagonal(const chain *c, const double *grounds, const double *right, double *moved, double *behind)
{
    int i;
    behind[0] = grounds[0];
    moved[0] = right[0];
    for (i = 1; i < c->count; i++) {
        const double share = c->bars[i - 1] / (c->bars[i - 1] + behind[i - 1]);
        behind[i] = grounds[i] + share * behind[i - 1];
        moved[i] = right[i] + share * moved[i - 1];
    }
    i = c->count - 1;
    moved[i] /= behind[i] > 0.0 ? behind[i] : 1.0;
    while (--i >= 0)
        moved[i] = (moved[i] + c->bars[i] * moved[i + 1]) / (c->bars[i] + behind[i]);
}

/* The displacements that balance the load in grooves as they are; the room is for five numbers a ball. */
static void chain_balance(const chain *c, double *x, double *room)
{
    const int n = c->count;
    double *const left = room, *const slope = room + n, *const step = room + 2 * n, *const at = room + 3 * n;
    double *const behind = room + 4 * n;
    double size = imbalance(c, x, left, slope), force = 0.0, stiffness = 0.0, share;
    int tried, halved, i;
    for (tried = 0; tried < STEPS && !(size <= BALANCED * c->scale + rounding(c, x)); tried++) {
        double next = size;
        tridiagonal(c, slope, left, step, behind);
        for (halved = 0, share = 1.0; halved < HALVINGS; halved++, share /= 2.0) {
            for (i = 0; i < n; i++)
                at[i] = x[i] + share * step[i];
            next = imbalance(c, at, left, slope);
            if (next < size)
                break;
        }
        for (i = 0; i < n; i++)
            x[i] = at[i];
        size = next;
    }
    for (i = 0; i < n; i++) {
        const ball b = ball_at(c, i, x[i]);
        force += b.force;
        stiffness += b.slope;
    }
    for (i = 0; i < n && stiffness > 0.0; i++)
        x[i] += (c->load - force) / stiffness;
}

/* Axial force of all balls at a common displacement beyond the load, and its slope. */
static double together(const chain *c, double x, double *slope)
{
    double force = -c->load;
    int body;
    *slope = 0.0;
    for (body = 0; body < c->nut->halves && body * c->nut->balls < c->count; body++) {
        const ball b = ball_at(c, body * c->nut->balls, x);
        force += c->nut->balls * b.force;
        *slope += c->nut->balls * b.slope;
    }
    return force;
}

/* About the displacement of a rigid screw. */
static double start(const chain *c, double guess)
{
    const double A = c->nut->centre_distance, alpha = c->nut->contact_angle;
    double touch = 0.0, reach, low, high, x, slope;
    int i;
    for (i = 0; i < c->count; i++) {
        const double across = A * cos(alpha), far = A - c->excess;
        touch = fmax(touch, fabs(sqrt(fmax(far * far - across * across, 0.0)) - A * sin(alpha) - c->offset[i]));
    }
    reach = touch / c->nut->lead_cosine + 2.0 * fmax(guess, 1e-12);
    low = -reach;
    high = reach;
    for (i = 0; i < STEPS && together(c, low, &slope) > 0.0; i++)
        low *= 2.0;
    for (i = 0; i < STEPS && together(c, high, &slope) < 0.0; i++)
        high *= 2.0;
    x = c->load < 0.0 ? low : high;
    for (i = 0; i < STEPS; i++) {
        const double over = together(c, x, &slope), newton = x - over / (slope > 0.0 ? slope : 1.0);
        if (over < 0.0)
            low = x;
        else
            high = x;
        if (fabs(over) <= START * c->scale || high - low <= 1e-16 * reach)
            break;
        x = newton > low && newton < high && slope > 0.0 ? newton : (low + high) / 2.0;
    }
    return x;
}

/* Displacements and gaps that balance the load; returns the radial imbalance that is left. The room is for nine numbers
   a ball. */
static double balance(chain *c, double guess, double *x, double *room)
{
    const int n = c->count;
    double *const slope = room, *const cross = room + n, *const by_gap[2] = {room + 2 * n, room + 3 * n};
    double *const rest = room + 4 * n;
    double size = 0.0, at;
    int tried, i, b;
    c->gap[0] = c->gap[1] = 0.0;
    c->body[0] = c->body[1] = widened(c, 0.0);
    at = start(c, guess);
    for (i = 0; i < n; i++)
        x[i] = at;
    if (!c->nut->swells) {
        chain_balance(c, x, rest);
        return 0.0;
    }
    for (tried = 0; tried < STEPS_OF_GAPS; tried++) {
        double push[2] = {0.0, 0.0}, own[2] = {0.0, 0.0}, through[2][2] = {{0.0, 0.0}, {0.0, 0.0}};
        double now[2] = {0.0, 0.0}, step[2] = {0.0, 0.0}, m[2][2], largest = 0.0;
        for (i = 0; i < n; i++) {
            const ball here = ball_at(c, i, x[i]);
            b = c->bodies == 2 && i >= n / 2;
            push[b] += here.push;
            own[b] += here.push_slope;
            slope[i] = here.slope;
            cross[i] = here.cross;
        }
        size = 0.0;
        for (b = 0; b < c->bodies; b++) {
            now[b] = push[b] - c->nut->radial_stiffness * c->gap[b];
            size = fmax(size, fabs(now[b]));
            largest = fmax(largest, fabs(push[b]));
        }
        if (tried > 0 && size <= BALANCED * c->scale + ROUNDING * largest)
            break;
        for (b = 0; b < c->bodies; b++) {
            for (i = 0; i < n; i++) /* rest: right side, and room of the elimination */
                rest[i] = (c->bodies == 2 && i >= n / 2) == b ? cross[i] : 0.0;
            tridiagonal(c, slope, rest, by_gap[b], rest + n);
        }
        for (i = 0; i < n; i++)
            for (b = 0; b < c->bodies; b++)
                through[c->bodies == 2 && i >= n / 2][b] += cross[i] * by_gap[b][i];
        for (b = 0; b < 2; b++) {
            m[b][0] = -through[b][0];
            m[b][1] = -through[b][1];
            m[b][b] += c->nut->radial_stiffness - own[b];
        }
        if (c->bodies == 1)
            step[0] = now[0] / m[0][0];
        else {
            const double d = m[0][0] * m[1][1] - m[0][1] * m[1][0];
            step[0] = (now[0] * m[1][1] - now[1] * m[0][1]) / d;
            step[1] = (now[1] * m[0][0] - now[0] * m[1][0]) / d;
        }
        for (b = 0; b < c->bodies; b++) {
            c->gap[b] += step[b];
            c->body[b] = widened(c, c->gap[b]);
            for (i = 0; i < n; i++)
                x[i] += by_gap[b][i] * step[b];
        }
        chain_balance(c, x, rest);
    }
    return size;
}

/* What oversize balls are too big by, so that each flank carries the preload without load. */
static double excess_of(const ballscrew_nut *nut, double preload)
{
    const double A = nut->centre_distance, alpha = nut->contact_angle, along = A * sin(alpha), across = A * cos(alpha);
    double sine = sin(alpha), opened = 0.0;
    if (nut->swells) {
        const double push = 2.0 * preload / (nut->lead_cosine * nut->radial_stiffness);
        const double gap = push * across / (along + push), left = across - gap;
        const double distance = sqrt(left * left + along * along);
        sine = along / distance;
        opened = gap * (2.0 * across - gap) / (A + distance);
    }
    return pow(preload / (nut->balls * sine * nut->lead_cosine * nut->load_deflection), 2.0 / 3.0) + opened;
}

/* Compliance of one body along the balls, and of the other. */
static double free_bodies(const chain *c)
{
    double compliance = 0.0;
    int i;
    for (i = 0; i + 1 < c->count; i++)
        compliance += 1.0 / c->bars[i];
    return compliance;
}

/* How far the loaded end of the screw moves against that of the nut, at displacements x of the balls. */
static double travel(const chain *c, const double *x)
{
    const double beta = c->first_share;
    return beta * x[0] + (1.0 - beta) * x[c->count - 1] + c->load * beta * (1.0 - beta) * free_bodies(c);
}

/* The load over that, for a small one more; of balls that carry nothing it is zero. The room is for six numbers a ball. */
static double rigidity(const chain *c, const double *x, double *room)
{
    const int n = c->count;
    double *const slope = room, *const cross = room + n, *const right = room + 2 * n, *const moved = room + 3 * n;
    double *const by_gap = room + 4 * n, *const behind = room + 5 * n;
    const double beta = c->first_share;
    double own[2] = {0.0, 0.0}, now[2] = {0.0, 0.0}, m[2][2] = {{0.0, 0.0}, {0.0, 0.0}}, gap[2] = {0.0, 0.0};
    double answer[2] = {0.0, 0.0}, carries = 0.0, compliance;
    int i, b, other;
    for (i = 0; i < n; i++) {
        const ball here = ball_at(c, i, x[i]);
        slope[i] = here.slope;
        cross[i] = here.cross;
        own[c->bodies == 2 && i >= n / 2] += here.push_slope;
        carries += here.slope;
        right[i] = 0.0;
    }
    if (!(carries > 0.0))
        return carries; /* none, or NaN */
    right[0] += beta;
    right[n - 1] += 1.0 - beta;
    tridiagonal(c, slope, right, moved, behind);
    compliance = beta * moved[0] + (1.0 - beta) * moved[n - 1];
    if (c->nut->swells) { /* the gaps follow, and move the balls in turn */
        for (i = 0; i < n; i++)
            now[c->bodies == 2 && i >= n / 2] += cross[i] * moved[i];
        for (b = 0; b < c->bodies; b++) {
            for (i = 0; i < n; i++)
                right[i] = (c->bodies == 2 && i >= n / 2) == b ? cross[i] : 0.0;
            tridiagonal(c, slope, right, by_gap, behind);
            answer[b] = beta * by_gap[0] + (1.0 - beta) * by_gap[n - 1];
            for (i = 0; i < n; i++)
                m[c->bodies == 2 && i >= n / 2][b] -= cross[i] * by_gap[i];
        }
        for (b = 0; b < c->bodies; b++)
            m[b][b] += c->nut->radial_stiffness - own[b];
        if (c->bodies == 1)
            gap[0] = now[0] / m[0][0];
        else {
            const double d = m[0][0] * m[1][1] - m[0][1] * m[1][0];
            for (b = 0; b < 2; b++) {
                other = 1 - b;
                gap[b] = (now[b] * m[other][other] - now[other] * m[b][other]) / d;
            }
        }
        for (b = 0; b < c->bodies; b++)
            compliance += answer[b] * gap[b];
    }
    return 1.0 / (compliance + beta * (1.0 - beta) * free_bodies(c));
}

/* The balls, and if there is room for it the state of the nut. */
static double solved(const ballscrew_nut *nut, double axial_load, double preload, double *room, double *found,
                     double *state)
{
    const int half = nut->balls, n = nut->halves * half;
    double *const facing = room, *const offset = room + n, *const rest = room + 2 * n;
    double *const forward = found, *const backward = found + n;
    double *const forward_angle = found + 2 * n, *const backward_angle = found + 3 * n;
    double *const x = forward_angle, *const bars = backward_angle; /* until they are written */
    const double load = fabs(axial_load) < NOTHING ? 0.0 : axial_load, works = fabs(load) + preload;
    const double K = nut->load_deflection, axial = sin(nut->contact_angle) * nut->lead_cosine;
    const double scale = fmax(works, half * K * pow(PICOMETRE, 1.5));
    const double guess = pow(scale / (half * axial * K), 2.0 / 3.0) / axial;
    double on_forward = 0.0, on_backward = 0.0, braced = 0.0, at_rest = 0.0, left, imbalanced, size;
    chain c;
    int i;
    c.nut = nut;
    c.facing = facing;
    c.offset = offset;
    c.bars = bars;
    c.scale = scale;
    c.excess = nut->four_contacts ? excess_of(nut, preload) : 0.0;
    for (i = 0; i < n; i++) {
        facing[i] = i >= half ? -1.0 : nut->halves == 1 && !nut->four_contacts && load < 0.0 ? -1.0 : 1.0;
        offset[i] = 0.0;
        bars[i] = nut->link / (i + 1 == half ? nut->step + nut->spacing : nut->step);
    }
    if (nut->halves == 2 && preload > 0.0) { /* each half by itself, the load at its inner end */
        const double alone = fmax(preload, half * K * pow(PICOMETRE, 1.5));
        double gap;
        c.count = half;
        c.bodies = 1;
        c.first_share = 0.0;
        c.load = preload;
        c.scale = alone;
        balance(&c, pow(alone / (half * axial * K), 2.0 / 3.0) / axial, x, rest);
        for (i = 0; i < half; i++)
            braced += ball_at(&c, i, x[i]).force;
        gap = 2.0 * x[half - 1] + preload / bars[half - 1];
        at_rest = nut->first_share * x[0] + (1.0 - nut->first_share) * (gap - x[0]);
        for (i = half; i < n; i++)
            offset[i] = gap * nut->lead_cosine;
        c.scale = scale;
    }
    c.count = n;
    c.bodies = nut->halves;
    c.first_share = nut->first_share;
    c.load = load;
    left = 0.0;
    if (works > 0.0)
        left = balance(&c, guess, x, rest);
    else { /* balls just touch; what rounding makes of that is no load */
        c.body[0] = c.body[1] = widened(&c, 0.0);
        for (i = 0; i < n; i++)
            x[i] = 0.0;
    }
    size = imbalance(&c, x, rest, rest + n);
    left = fmax(left, fmax(size - rounding(&c, x), 0.0));
    for (i = 0; i < n; i++) {
        const grooves *const g = &c.body[c.bodies == 2 && i >= half];
        const double at = x[i];
        int k;
        forward[i] = backward[i] = 0.0;
        rest[i] = rest[n + i] = 0.0;
        for (k = 0; k <= nut->four_contacts; k++) {
            const flank f = flank_of(&c, g, k == 0 ? facing[i] : -facing[i], offset[i], at);
            const int is_forward = (k == 0 ? facing[i] : -facing[i]) > 0.0;
            (is_forward ? forward : backward)[i] = works > 0.0 ? f.load : 0.0;
            (is_forward ? rest : rest + n)[i] = asin(f.sine);
            *(is_forward ? &on_forward : &on_backward) += works > 0.0 ? fabs(f.force) : 0.0;
        }
    }
    if (state) {
        state[0] = travel(&c, x) - at_rest;
        state[1] = works == 0.0 ? 0.0 : rigidity(&c, x, rest + 2 * n);
        state[2] = load < 0.0 ? on_forward : on_backward;
    }
    for (i = 0; i < n; i++) {
        forward_angle[i] = rest[i];
        backward_angle[i] = rest[n + i];
    }
    imbalanced = fabs(on_forward - on_backward - load);
    if (nut->halves == 2 && preload > 0.0)
        imbalanced = fmax(imbalanced, fabs(braced - preload));
    if (!(works > 0.0))
        return 0.0;
    return left / scale > LARGEST_OF_A_BALL ? left / scale : imbalanced / scale;
}

double ballscrew_loads(const ballscrew_nut *nut, double axial_load, double preload, double *room, double *found)
{
    return solved(nut, axial_load, preload, room, found, 0);
}

double ballscrew_loads_and_state(const ballscrew_nut *nut, double axial_load, double preload, double *room,
                                 double *found, double *state)
{
    return solved(nut, axial_load, preload, room, found, state);
}
