/* Closed forms of three mechanisms over n positions of the crank: what a compiler can do at best. */
#include <math.h>

/* The left one of the two points at distances b from (px, py) and c from (qx, qy), by Heron in factors. */
static inline void dyad(double px, double py, double qx, double qy, double b, double c,
                        double *x, double *y)
{
    double dx = qx - px, dy = qy - py, s = sqrt(dx * dx + dy * dy), ux = dx / s, uy = dy / s;
    double along = ((s - c) * (s + c) + b * b) / (2.0 * s);
    double h = sqrt((s + b + c) * (b + c - s) * (s - b + c) * (s + b - c)) / (2.0 * s);
    *x = px + along * ux - h * uy;
    *y = py + along * uy + h * ux;
}

/* Torque on the crank for a torque t on the rocker; data: a, b, c, d, t. */
void four_bar(int n, const double *angle, const double *data, double *torque)
{
    double a = data[0], b = data[1], c = data[2], d = data[3], t = data[4];
    for (int k = 0; k < n; k++) {
        double bx = a * cos(angle[k]), by = a * sin(angle[k]), cx, cy;
        dyad(bx, by, d, 0.0, b, c, &cx, &cy);
        double ex = cx - bx, ey = cy - by;
        torque[k] = -t * (ey * bx - ex * by) / (ey * (cx - d) - ex * cy);
    }
}

/* Torque on the crank for a force f on the piston along the guide; data: r, l, e (offset), f. */
void slider_crank(int n, const double *angle, const double *data, double *torque)
{
    double r = data[0], l = data[1], e = data[2], f = data[3];
    for (int k = 0; k < n; k++) {
        double bx = r * cos(angle[k]), by = r * sin(angle[k]), rise = by - e;
        double reach = sqrt((l - rise) * (l + rise));
        torque[k] = f * (by + bx * rise / reach);
    }
}

/* Torque on the crank of a Stephenson six-bar for a torque t on its last rocker.
   data: a, b, c, d, share along and height beside the coupler of its point E, b2, c2, gx, gy, t. */
void stephenson(int n, const double *angle, const double *data, double *torque)
{
    double a = data[0], b = data[1], c = data[2], d = data[3], share = data[4], height = data[5];
    double b2 = data[6], c2 = data[7], gx = data[8], gy = data[9], t = data[10];
    for (int k = 0; k < n; k++) {
        double bx = a * cos(angle[k]), by = a * sin(angle[k]), cx, cy, fx, fy;
        dyad(bx, by, d, 0.0, b, c, &cx, &cy);
        double ux = (cx - bx) / b, uy = (cy - by) / b;
        double ex = bx + share * ux - height * uy, ey = by + share * uy + height * ux;
        dyad(ex, ey, gx, gy, b2, c2, &fx, &fy);
        /* rate of the coupler over that of the crank: C moves square to CD */
        double rx = cx - d, dx = cx - bx, dy = cy - by;
        double w3 = (by * rx - bx * cy) / (dx * cy - dy * rx);
        double vx = -by - w3 * (ey - by), vy = bx + w3 * (ex - bx);
        double px = fx - ex, py = fy - ey;
        double w6 = (vx * px + vy * py) / (px * -(fy - gy) + py * (fx - gx));
        torque[k] = -t * w6;
    }
}
