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

/* A solution of ten linear equations in place, by elimination with partial pivoting. */
static void solve10(double a[10][10], double b[10])
{
    for (int c = 0; c < 10; c++) {
        int top = c;
        for (int r = c + 1; r < 10; r++)
            if (fabs(a[r][c]) > fabs(a[top][c])) top = r;
        for (int k = c; k < 10; k++) { double held = a[c][k]; a[c][k] = a[top][k]; a[top][k] = held; }
        double held = b[c]; b[c] = b[top]; b[top] = held;
        for (int r = c + 1; r < 10; r++) {
            double ratio = a[r][c] / a[c][c];
            if (ratio == 0.0) continue;
            for (int k = c + 1; k < 10; k++) a[r][k] -= ratio * a[c][k];
            b[r] -= ratio * b[c];
        }
    }
    for (int c = 9; c >= 0; c--) {
        for (int k = c + 1; k < 10; k++) b[c] -= a[c][k] * b[k];
        b[c] /= a[c][c];
    }
}

/* The ends of the ten distances of a double butterfly: 0 to 4 are its unknown places P6 to P10, then P2, P3
   and, on the crank, P4 and P5. */
static const int ENDS[10][2] = {{0, 1}, {0, 2}, {1, 2}, {0, 3}, {0, 4}, {3, 4},
                                {5, 1}, {6, 3}, {7, 2}, {8, 4}};

/* Derivatives of half the squares of the distances, and how far these are from half of those given. */
static void distances(const double p[9][2], const double *given, double a[10][10], double b[10])
{
    for (int e = 0; e < 10; e++) {
        int i = ENDS[e][0], j = ENDS[e][1];
        double x = p[j][0] - p[i][0], y = p[j][1] - p[i][1];
        for (int k = 0; k < 10; k++) a[e][k] = 0.0;
        if (i < 5) { a[e][2 * i] = -x; a[e][2 * i + 1] = -y; }
        a[e][2 * j] = x;
        a[e][2 * j + 1] = y;
        b[e] = 0.5 * (x * x + y * y - given[e] * given[e]);
    }
}

/* Torque on the crank of a double butterfly for a torque t on its link through P5 and P10, whose places only
   Newton's method finds, each row from the one before it. data: P1, P2, P3; P4 along the crank, P5 along and
   beside it; ten distances; ten coordinates at the angle that follows; t. */
void double_butterfly(int n, const double *angle, const double *data, double *torque)
{
    const double *given = data + 9;
    double p[9][2], a[10][10], b[10], at = data[29], t = data[30];
    for (int k = 0; k < 5; k++) { p[k][0] = data[19 + 2 * k]; p[k][1] = data[20 + 2 * k]; }
    for (int k = 0; k < 2; k++) { p[5 + k][0] = data[2 + 2 * k]; p[5 + k][1] = data[3 + 2 * k]; }
    for (int row = -64; row < n; row++) { /* some steps lead to the first row */
        double to = row < 0 ? at + (angle[0] - at) * (row + 65) / 65.0 : angle[row];
        double c = cos(to), s = sin(to), most = 1.0;
        p[7][0] = data[0] + data[6] * c;
        p[7][1] = data[1] + data[6] * s;
        p[8][0] = data[0] + data[7] * c - data[8] * s;
        p[8][1] = data[1] + data[7] * s + data[8] * c;
        for (int round = 0; round < 25 && most > 1e-9; round++) {
            distances(p, given, a, b);
            solve10(a, b);
            most = 0.0;
            for (int k = 0; k < 10; k++) {
                p[k / 2][k % 2] -= b[k];
                if (fabs(b[k]) > most) most = fabs(b[k]);
            }
        }
        if (row < 0) continue;
        distances(p, given, a, b);
        double v4x = data[1] - p[7][1], v4y = p[7][0] - data[0];
        double v5x = data[1] - p[8][1], v5y = p[8][0] - data[0];
        for (int k = 0; k < 8; k++) b[k] = 0.0;
        b[8] = (p[2][0] - p[7][0]) * v4x + (p[2][1] - p[7][1]) * v4y;
        b[9] = (p[4][0] - p[8][0]) * v5x + (p[4][1] - p[8][1]) * v5y;
        solve10(a, b);
        double x = p[4][0] - p[8][0], y = p[4][1] - p[8][1];
        torque[row] = -t * (x * (b[9] - v5y) - y * (b[8] - v5x)) / (x * x + y * y);
    }
}
