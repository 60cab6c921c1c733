/* Closed forms of three mechanisms, as one would write them by hand: the limit for a sweep.
 *
 * Each takes the crank angle in degrees and gives the crank torque that balances the load; a pointer to
 * dimensions is passed so that nothing is known at compile time. Prints nothing: loaded by ctypes.
 */
#include <math.h>

#define RADIAN (M_PI / 180.0)

/* d = {a, b, c, f, p, load}: crank AB, coupler BC, rocker CD, frame AD, DE along DC, force at E along -x */
void four_bar(const double *deg, double *torque, long n, const double *d) {
    const double a = d[0], b = d[1], c = d[2], f = d[3], p = d[4], load = d[5];
    for (long i = 0; i < n; i++) {
        const double t = deg[i] * RADIAN, bx = a * cos(t), by = a * sin(t);
        const double dx = f - bx, dy = -by, e2 = dx * dx + dy * dy, e = sqrt(e2);
        const double along = (e2 + b * b - c * c) / (2.0 * e), h = sqrt(b * b - along * along);
        const double cx = bx + (along * dx - h * dy) / e, cy = by + (along * dy + h * dx) / e;
        const double ux = cx - bx, uy = cy - by, vx = cx - f, vy = cy;
        const double w4 = (bx * uy - by * ux) / (vx * uy - vy * ux);
        torque[i] = -load * w4 * (p / c) * vy;
    }
}

/* d = {r, l, e, load}: crank, rod, offset of the guide, force on the block along -x */
void slider_crank(const double *deg, double *torque, long n, const double *d) {
    const double r = d[0], l = d[1], e = d[2], load = d[3];
    for (long i = 0; i < n; i++) {
        const double t = deg[i] * RADIAN, bx = r * cos(t), by = r * sin(t);
        const double h = e - by, along = sqrt(l * l - h * h);
        const double v = -by + bx * h / along; /* velocity of the block for a unit rate of the crank */
        torque[i] = load * v;
    }
}

/* d = {a, b, c, f, ex, ey, s, t, gx, gy, load}: a four-bar, coupler point E (along BC, square to it), the
 * dyad E-F of length s and F-G of length t; a torque on link 6 */
void stephenson(const double *deg, double *torque, long n, const double *d) {
    const double a = d[0], b = d[1], c = d[2], f = d[3], px = d[4], py = d[5], s = d[6], u = d[7];
    const double gx = d[8], gy = d[9], load = d[10];
    for (long i = 0; i < n; i++) {
        const double q = deg[i] * RADIAN, bx = a * cos(q), by = a * sin(q);
        double dx = f - bx, dy = -by, e2 = dx * dx + dy * dy, e = sqrt(e2);
        double along = (e2 + b * b - c * c) / (2.0 * e), h = sqrt(b * b - along * along);
        const double cx = bx + (along * dx - h * dy) / e, cy = by + (along * dy + h * dx) / e;
        const double ux = cx - bx, uy = cy - by, vx = cx - f, vy = cy;
        const double k = 1.0 / (vx * uy - vy * ux);
        const double w3 = (bx * vy - by * vx) * k, w4 = (bx * uy - by * ux) * k;
        (void)w4;
        const double ex = bx + (px * ux - py * uy) / b, ey = by + (px * uy + py * ux) / b;
        const double vex = -by - w3 * (ey - by), vey = bx + w3 * (ex - bx);
        dx = gx - ex, dy = gy - ey, e2 = dx * dx + dy * dy, e = sqrt(e2);
        along = (e2 + s * s - u * u) / (2.0 * e), h = sqrt(s * s - along * along);
        const double fx = ex + (along * dx - h * dy) / e, fy = ey + (along * dy + h * dx) / e;
        const double mx = fx - ex, my = fy - ey, nx = fx - gx, ny = fy - gy;
        const double w6 = (vex * mx + vey * my) / (nx * my - ny * mx);
        torque[i] = -load * w6;
    }
}
