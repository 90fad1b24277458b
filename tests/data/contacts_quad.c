/* Writes contacts.csv, reference values of Pi0, Eeq, Gamma, Delta0 over the whole range of materials and radii, in quadruple precision.
 *
 *     gcc -O3 -march=native contacts_quad.c -o contacts_quad -lquadmath -lm
 *     ./contacts_quad > contacts.csv          # 14 minutes on one core
 *     ./contacts_quad check FILE...           # recomputes the rows of a csv without `kind` and compares
 *     ./contacts_quad point x E1 nu1 E0 nu0   # everything that both methods say about one point
 *
 * S(q) = sphere + X(q)/e1 is the symbol of the contact equation (sphere = 1, or 0 for a rigid one), x = a/t. Two methods share nothing
 * but the function that evaluates X:
 *
 * G  Galerkin in even Legendre polynomials on the real q axis; Gamma and Delta0 from the variational (energy) form.
 * W  Wiener-Hopf: S = S_+ S_-, and an integral equation on a ray of the first quadrant for the wave sent from one edge to the other,
 *    V(z) = sqrt(S_inf) + s/(2 pi i) int_ray [ f V dzeta/(zeta + z) + conj(f V dzeta)/(z - conj zeta) ],   s = +1 even, -1 odd,
 *    f = e^{2 i zeta} S_+(zeta/x)^2 [1/S(zeta/x) - g(zeta)],
 *    where g may be any function analytic and bounded in the upper half plane (its two rays cancel); it is chosen to remove f(0).
 *    a(z) = Re[e^{iz} S_+ V_even]/S and b(z) = Im[e^{iz} S_+ V_odd]/S are entire, even and odd. With a = a0 + a1 z^2 + .. and
 *    b = B1 z + B2 z^3 + ..:   Gamma = es a0,  Delta0 = -2 a1/a0,  Eeq = es a0 B1,  Pi0 = 8 es (a0 B2 - a1 B1).
 *    All integrals over rays are trapezoidal sums in a logarithmic variable; the zeros and poles of S lie above 53.9 degrees.
 */
#include <math.h>
#include <quadmath.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

typedef __float128 Q;
typedef __complex128 C;
#define RE(z) __real__(z)
#define IM(z) __imag__(z)
static C mk(Q re, Q im) { C z; RE(z) = re; IM(z) = im; return z; }
static C mul(C a, C b) { return mk(RE(a) * RE(b) - IM(a) * IM(b), RE(a) * IM(b) + IM(a) * RE(b)); }
static C scale(Q a, C b) { return mk(a * RE(b), a * IM(b)); }
static C conjugate(C a) { return mk(RE(a), -IM(a)); }
static Q norm2(C a) { return RE(a) * RE(a) + IM(a) * IM(a); }
static C inverse(C a) { Q n = 1 / norm2(a); return mk(RE(a) * n, -IM(a) * n); }
static C cexponential(C a) { Q r = expq(RE(a)), s, c; sincosq(IM(a), &s, &c); return mk(r * c, r * s); }
static void *take(size_t bytes) { void *p = malloc(bytes); if (!p) { perror("malloc"); exit(1); } return p; }

/* ---------------------------------------------------------------- the symbol */

typedef struct { Q sphere, e1, m, c0, c1, c2, c3, c4, x0, s0, sinf; } Material;

static Material material(Q e1_over_e2, Q nu1, Q e0_over_e2, Q nu0) {
    Material t;
    Q ratio;
    int rigid_sphere = e1_over_e2 == 0;
    t.sphere = rigid_sphere ? 0 : 1;
    t.e1 = rigid_sphere ? 1 : e1_over_e2 / ((1 - nu1) * (1 + nu1));
    ratio = isinfq(e0_over_e2) ? 0 : (rigid_sphere ? 1 : e1_over_e2) / e0_over_e2;
    Q m = t.m = ratio * (1 + nu0) / (1 + nu1), g1 = 3 - 4 * nu1, g0 = 3 - 4 * nu0;
    t.c0 = m * (1 + g1) * (1 + g0);
    t.c1 = 2 * m * m * g0 + m * (g0 - 1) * (g1 - 1) + 2 * g1;
    t.c2 = 4 * m * m * g0 - 8 * m * nu1 * (1 - 2 * nu0) + 4 * (1 - 2 * nu1);
    t.c3 = (1 + g1) * (1 + g1);
    t.c4 = (1 + g1) * (m * (g0 - 1) + 2);
    t.x0 = t.c0 / t.c3;
    t.s0 = t.sphere + t.x0 / t.e1;
    t.sinf = t.sphere + 1 / t.e1;
    return t;
}

/* X(q) for Re q > 0: series of sinh 2q - 2q and cosh 2q - 1 - 2q^2 for small q, scaled exponentials otherwise. */
static C compliance(const Material *t, C q) {
    C n, d;
    if (norm2(q) < 1) {
        C y = scale(2, q), y2 = mul(y, y), term = y, sh = 0, ch = 0;
        for (int k = 2; k < 60; k += 2) {
            term = scale((Q)1 / k, mul(term, y)); /* y^k/k! */
            if (k > 2) ch += term;
            term = scale((Q)1 / (k + 1), mul(term, y));
            sh += term;
            if (norm2(term) < 1e-80Q * norm2(sh)) break;
        }
        C q2 = scale((Q)0.25, y2);
        n = mk(t->c0 / 2, 0) + scale(t->c0 / 2, ch + scale(2, q2)) + scale(t->c1 / 2, sh) + scale(t->c2, q);
        d = mk(t->c3 / 2, 0) + scale(t->c1 / 2, ch) + scale(t->c0 / 2, sh + y) + scale(t->c4, q2);
    } else {
        C e = cexponential(scale(-2, q)), e2 = mul(e, e), qe = mul(q, e), q2e = mul(q, qe), one = mk(1, 0);
        n = scale(t->c0 / 2, one + e2) + scale(t->c1 / 2, one - e2 - scale(4, qe)) + scale(2 * t->c2, qe);
        d = scale(t->c3, e) + scale(t->c1 / 2, one + e2 - scale(2, e) - scale(4, q2e)) + scale(t->c0 / 2, one - e2) + scale(2 * t->c4, q2e);
    }
    return mul(n, inverse(d));
}

/* X and q X' for real q. */
static void compliance_real(const Material *t, Q q, Q *x, Q *slope) {
    Q n, d, dn, dd;
    if (q < 1) {
        Q y = 2 * q, term = y, sh = 0, ch = 0;
        for (int k = 2; k < 60; k += 2) {
            term *= y / k;
            if (k > 2) ch += term;
            term *= y / (k + 1);
            sh += term;
            if (term < 1e-40Q * sh) break;
        }
        Q cosh1 = ch + 2 * q * q;
        n = t->c0 / 2 * (1 + cosh1) + t->c1 / 2 * sh + t->c2 * q;
        d = t->c3 / 2 + t->c1 / 2 * ch + t->c0 / 2 * (sh + y) + t->c4 * q * q;
        dn = t->c0 * (sh + y) + t->c1 * cosh1 + t->c2;
        dd = t->c1 * sh + t->c0 * (1 + cosh1) + 2 * t->c4 * q;
    } else {
        Q e = expq(-2 * q), e2 = e * e; /* all times 2 e^{-2q} */
        n = t->c0 / 2 * (1 + e2) + t->c1 / 2 * (1 - e2 - 4 * q * e) + 2 * t->c2 * q * e;
        d = t->c3 * e + t->c1 / 2 * (1 + e2 - 2 * e - 4 * q * q * e) + t->c0 / 2 * (1 - e2) + 2 * t->c4 * q * q * e;
        dn = t->c0 * (1 - e2) + t->c1 * (1 + e2 - 2 * e) + 2 * t->c2 * e;
        dd = t->c1 * (1 - e2 - 4 * q * e) + t->c0 * (1 + e2) + 4 * t->c4 * q * e;
    }
    *x = n / d;
    *slope = q * (dn - *x * dd) / d;
}

static C symbol(const Material *t, C q) { return mk(t->sphere, 0) + scale(1 / t->e1, compliance(t, q)); }

/* ---------------------------------------------------------------- results */

typedef struct { Q pi0, eeq, gamma, delta0; } Values;

static double disagreement(Values a, Values b) {
    Q p[4] = {a.pi0, a.eeq, a.gamma, a.delta0}, r[4] = {b.pi0, b.eeq, b.gamma, b.delta0};
    double worst = 0;
    for (int i = 0; i < 4; i++) {
        double e = (double)fabsq(p[i] / r[i] - 1);
        if (!(e <= worst)) worst = e;
    }
    return worst;
}

static int digits(double error) {
    if (!(error < 1)) return 0;
    int d = error > 0 ? (int)floor(-log10(error)) : 40;
    return d > 20 ? 20 : d;
}

/* ---------------------------------------------------------------- G: Galerkin */

typedef struct { double modes0, modes1; int nodes; double phase, ratio, qmax; } GalerkinRule;

static void gauss(int n, Q *node, Q *weight) {
    for (int i = 0; i < n; i++) {
        Q s = cosq(M_PIq * (i + 0.75Q) / (n + 0.5Q)), dp = 1;
        for (int step = 0; step < 12; step++) {
            Q p0 = 1, p1 = s;
            for (int k = 2; k <= n; k++) { Q p = ((2 * k - 1) * s * p1 - (k - 1) * p0) / k; p0 = p1; p1 = p; }
            dp = n * (s * p1 - p0) / (s * s - 1);
            Q ds = p1 / dp;
            s -= ds;
            if (fabsq(ds) < 1e-30Q) break;
        }
        Q p0 = 1, p1 = s;
        for (int k = 2; k <= n; k++) { Q p = ((2 * k - 1) * s * p1 - (k - 1) * p0) / k; p0 = p1; p1 = p; }
        dp = n * (s * p1 - p0) / (s * s - 1);
        node[i] = s;
        weight[i] = 2 / ((1 - s * s) * dp * dp);
    }
}

/* (-1)^n sqrt(4n+1) j_2n(z), n < count. */
static void bessel(Q z, int count, const Q *root, Q *out, Q *work) {
    Q s, c, inv = 1 / z;
    sincosq(z, &s, &c);
    Q j0 = z < 1e-4Q ? 1 - z * z / 6 * (1 - z * z / 20 * (1 - z * z / 42 * (1 - z * z / 72))) : s * inv, j1 = (j0 - c) * inv;
    if (z > 2 * count + 2) {
        Q p = j0, r = j1;
        for (int k = 0; k < 2 * count; k += 2) {
            out[k / 2] = (k % 4 ? -1 : 1) * root[k / 2] * p;
            p = (2 * k + 3) * inv * r - p;
            r = (2 * k + 5) * inv * p - r;
        }
        return;
    }
    int top = 2 * count + (z < 1 ? 30 : 60 + count);
    Q up = 0, here = 1e-4900Q;
    for (int k = top; k >= 0; k--) {
        if (k < 2 * count + 1) work[k] = here;
        Q down = (2 * k + 1) * inv * here - up;
        up = here;
        here = down;
    }
    Q norm = fabsq(j0) > fabsq(j1) || z < 1 ? j0 / work[0] : j1 / work[1];
    for (int n = 0; n < count; n++) out[n] = (n % 2 ? -1 : 1) * root[n] * norm * work[2 * n];
}

static Values galerkin(const Material *t, Q x, const GalerkinRule *rule) {
    int count = (int)(rule->modes0 + rule->modes1 * sqrt((double)x));
    Q *node = take(sizeof(Q) * rule->nodes), *weight = take(sizeof(Q) * rule->nodes);
    gauss(rule->nodes, node, weight);
    size_t cap = 0, total = 0;
    Q *js = NULL, *slopes = NULL;
    Q *a = take(sizeof(Q) * count * count), *root = take(sizeof(Q) * count), *work = take(sizeof(Q) * (2 * count + 4));
    for (int i = 0; i < count * count; i++) a[i] = 0;
    for (int n = 0; n < count; n++) root[n] = sqrtq(4 * n + 1);
    Q lo = 0, hi = 0.05Q * (t->m > 1 ? 1 / t->m : 1), widest = rule->phase / x;
    Q *row = take(sizeof(Q) * count);
    while (lo < rule->qmax) {
        if (hi - lo > widest) hi = lo + widest;
        for (int i = 0; i < rule->nodes; i++) {
            Q q = (lo + hi) / 2 + (hi - lo) / 2 * node[i], w = (hi - lo) / 2 * weight[i] * x * 2 / M_PIq / t->e1, xx, slope;
            compliance_real(t, q, &xx, &slope);
            if (total == cap) {
                cap = cap ? 2 * cap : 1024;
                js = realloc(js, sizeof(Q) * cap * count);
                slopes = realloc(slopes, sizeof(Q) * cap);
                if (!js || !slopes) exit(1);
            }
            Q *j = js + total * count;
            bessel(q * x, count, root, j, work);
            slopes[total++] = w * slope;
            int used = count;
            while (used > 1 && fabsq(j[used - 1]) < 1e-36Q) used--;
            Q wx = w * (xx - 1);
            for (int r = 0; r < used; r++) row[r] = wx * j[r];
            for (int r = 0; r < used; r++)
                for (int s = 0; s <= r; s++) a[r * count + s] += row[r] * j[s];
        }
        lo = hi;
        hi = lo * rule->ratio;
    }
    for (int r = 0; r < count; r++) a[r * count + r] += t->sinf;
    for (int r = 0; r < count; r++) { /* Cholesky */
        for (int s = 0; s <= r; s++) {
            Q sum = a[r * count + s];
            for (int k = 0; k < s; k++) sum -= a[r * count + k] * a[s * count + k];
            a[r * count + s] = s < r ? sum / a[s * count + s] : sqrtq(sum);
        }
    }
    Q *g1 = take(sizeof(Q) * count), *g2 = take(sizeof(Q) * count), *g[2] = {g1, g2};
    for (int n = 0; n < count; n++) g1[n] = g2[n] = 0;
    g1[0] = 1;
    g2[0] = 1 / (Q)3;
    g2[1] = 2 / (3 * sqrtq(5));
    for (int i = 0; i < 2; i++) {
        for (int r = 0; r < count; r++) {
            for (int k = 0; k < r; k++) g[i][r] -= a[r * count + k] * g[i][k];
            g[i][r] /= a[r * count + r];
        }
        for (int r = count - 1; r >= 0; r--) {
            for (int k = r + 1; k < count; k++) g[i][r] -= a[k * count + r] * g[i][k];
            g[i][r] /= a[r * count + r];
        }
    }
    Q d11 = 0, d12 = 0;
    for (size_t i = 0; i < total; i++) {
        Q h1 = 0, h2 = 0, *j = js + i * count;
        for (int n = 0; n < count; n++) { h1 += j[n] * g1[n]; h2 += j[n] * g2[n]; }
        d11 += slopes[i] * h1 * h1;
        d12 += slopes[i] * h1 * h2;
    }
    Values v;
    v.eeq = g1[0];
    v.gamma = sqrtq((v.eeq + d11) / t->sinf);
    v.delta0 = (3 * g2[0] + d12) / t->sinf / (v.gamma * v.gamma);
    v.pi0 = 4 * (v.delta0 * g1[0] - g2[0]);
    free(node); free(weight); free(js); free(slopes); free(a); free(root); free(work); free(row); free(g1); free(g2);
    return v;
}

/* ---------------------------------------------------------------- W: Wiener-Hopf */

typedef struct { double degrees, digits; int chebyshev; } RayRule;
static const double FIRST_SINGULARITY = 53.9;

/* ln(S/S_inf) on the ray arg t = -degrees, at t = exp(u), u = top - k step. */
typedef struct { int count; Q step; C *t2, *tl; } Branch;

static Branch branch(const Material *t, double degrees, double step, double bottom) {
    Branch b;
    Q top = 3.6Q, angle = -(Q)degrees * M_PIq / 180, last = 0;
    b.step = step;
    b.count = (int)((3.6 - bottom) / step) + 1;
    b.t2 = take(sizeof(C) * b.count);
    b.tl = take(sizeof(C) * b.count);
    C dir = cexponential(mk(0, angle));
    for (int k = 0; k < b.count; k++) {
        C q = scale(expq(top - k * b.step), dir), s = scale(1 / t->sinf, symbol(t, q));
        Q arg = atan2q(IM(s), RE(s));
        arg += 2 * M_PIq * rintq((last - arg) / (2 * M_PIq));
        last = arg;
        b.t2[k] = mul(q, q);
        b.tl[k] = mul(q, mk(logq(norm2(s)) / 2, arg));
    }
    return b;
}

/* S_+(q) for 0 <= arg q. */
static C factor(const Material *t, const Branch *b, C q) {
    C sum = 0, q2 = mul(q, q);
    Q tiny = norm2(q2) * 1e-112Q;
    for (int k = 0; k < b->count; k++) {
        if (norm2(b->t2[k]) < tiny) break;
        sum += mul(b->tl[k], inverse(b->t2[k] - q2));
    }
    C l = scale(b->step / M_PIq, mul(mk(0, -1), mul(q, sum)));
    return cexponential(l + mk(logq(t->sinf) / 2, 0));
}

/* LU with partial pivoting in place, in blocks, and its solve. */
static void lu(double *a, int n, int *pivot) {
    enum { NB = 48 };
    for (int k0 = 0; k0 < n; k0 += NB) {
        int k1 = k0 + NB < n ? k0 + NB : n;
        for (int k = k0; k < k1; k++) {
            int p = k;
            for (int i = k + 1; i < n; i++) if (fabs(a[(size_t)i * n + k]) > fabs(a[(size_t)p * n + k])) p = i;
            pivot[k] = p;
            for (int j = 0; p != k && j < n; j++) {
                double s = a[(size_t)k * n + j];
                a[(size_t)k * n + j] = a[(size_t)p * n + j];
                a[(size_t)p * n + j] = s;
            }
            for (int i = k + 1; i < n; i++) {
                double f = a[(size_t)i * n + k] /= a[(size_t)k * n + k];
                for (int j = k + 1; j < k1; j++) a[(size_t)i * n + j] -= f * a[(size_t)k * n + j];
            }
        }
        for (int k = k0; k < k1; k++)
            for (int i = k + 1; i < k1; i++) {
                double f = a[(size_t)i * n + k];
                for (int j = k1; j < n; j++) a[(size_t)i * n + j] -= f * a[(size_t)k * n + j];
            }
        for (int i = k1; i < n; i++) {
            double *ri = a + (size_t)i * n;
            int k = k0;
            for (; k + 3 < k1; k += 4) {
                const double *r0 = a + (size_t)k * n, *r1 = r0 + n, *r2 = r1 + n, *r3 = r2 + n;
                double f0 = ri[k], f1 = ri[k + 1], f2 = ri[k + 2], f3 = ri[k + 3];
                for (int j = k1; j < n; j++) ri[j] -= f0 * r0[j] + f1 * r1[j] + f2 * r2[j] + f3 * r3[j];
            }
            for (; k < k1; k++) for (int j = k1; j < n; j++) ri[j] -= ri[k] * a[(size_t)k * n + j];
        }
    }
}

static void lu_solve(const double *a, int n, const int *pivot, double *b) {
    for (int k = 0; k < n; k++) { double s = b[k]; b[k] = b[pivot[k]]; b[pivot[k]] = s; }
    for (int i = 0; i < n; i++) for (int k = 0; k < i; k++) b[i] -= a[(size_t)i * n + k] * b[k];
    for (int i = n - 1; i >= 0; i--) {
        for (int k = i + 1; k < n; k++) b[i] -= a[(size_t)i * n + k] * b[k];
        b[i] /= a[(size_t)i * n + i];
    }
}

static int ray_points, ray_steps, branch_points;

/* For S(0) > 0: where S(0) = 0 (both bodies rigid) the equation on the ray has neutral power laws at zeta = 0 and a cut-off there
 * never stops mattering; wiener_hopf below gets round that. */

static Values wiener_hopf_elastic(const Material *t, Q x, const RayRule *rule) {
    double need = rule->digits * log(10), rad = M_PI / 180;
    Q theta = (Q)rule->degrees * M_PIq / 180;
    /* The scale beta on which S leaves S(0). */
    Q beta = 0;
    for (double u = -60; u < 3.4; u += 0.25) {
        Q q = expq(u);
        if (fabsq(RE(symbol(t, mk(q, 0))) / t->s0 - 1) > 0.3Q) { beta = q; break; }
    }
    double log_xb = log((double)x) + (beta > 0 ? log((double)beta) : 0);
    /* Below xb = x beta what is left of f is of order zeta/xb, its integral of order zeta^2/xb. */
    double low = (-need + log_xb) / 2;
    if (low < -need) low = -need;
    if (low > -12) low = -12;
    low -= 6; /* logarithms, and cancellation further up */
    double strip = fmin(rule->degrees, FIRST_SINGULARITY - rule->degrees) * rad, h = 2 * M_PI * strip / (need + 2);
    double curve = log_xb >= 0 ? 0.5 / -low : 0.5 / need;
    double high = log(need / (2 * sin(rule->degrees * rad)));
    double tau0 = (1 - sqrt(1 - 4 * curve * low)) / (2 * curve), tau1 = (1 - sqrt(1 - 4 * curve * high)) / (2 * curve);
    int n = (int)((tau1 - tau0) / h) + 2;
    ray_points = n;

    double slope = (FIRST_SINGULARITY - rule->degrees) / 2, bottom = low - log((double)x) - need - 6;
    double need2 = need + 4;
    Branch b = branch(t, slope, 2 * M_PI * (FIRST_SINGULARITY - slope) * rad / need2, bottom);
    Branch b0 = branch(t, FIRST_SINGULARITY / 2, M_PI * FIRST_SINGULARITY * rad / need2, -3 - log((double)x) - need - 6);
    branch_points = b.count;

    Q *r = take(sizeof(Q) * n);
    C *w = take(sizeof(C) * n), dir = cexponential(mk(0, theta));
    for (int i = 0; i < n; i++) {
        Q tau = tau0 + i * (Q)h, u = tau - curve * tau * tau;
        r[i] = expq(u);
        C zeta = scale(r[i], dir), q = scale(1 / x, zeta), sp = factor(t, &b, q), inner = inverse(symbol(t, q));
        C pole = beta > 0 ? mk(1, 0) + scale(1 / (x * beta), mul(mk(0, -1), zeta)) : mk(1, 0);
        inner -= scale(1 / t->s0, inverse(mul(pole, pole)));
        C f = mul(mul(cexponential(mul(mk(0, 2), zeta)), mul(sp, sp)), inner);
        w[i] = mul(scale((Q)h * (1 - 2 * (Q)curve * tau) / (2 * M_PIq), mul(f, zeta)), mk(0, -1));
    }
    /* V_i = sqrt(S_inf) + s sum_j [P_j/(zeta_j + zeta_i) + conj P_j/(conj zeta_j - zeta_i)], P = w V. */
    Q *cm = take(sizeof(Q) * n * n), *dm = take(sizeof(Q) * n * n), c2 = 2 * cosq(2 * theta);
    for (int i = 0; i < n; i++)
        for (int j = 0; j <= i; j++) {
            cm[i * n + j] = cm[j * n + i] = 1 / (r[i] + r[j]);
            dm[i * n + j] = dm[j * n + i] = 1 / (r[i] * r[i] + r[j] * r[j] - c2 * r[i] * r[j]);
        }
    int nn = rule->chebyshev, dim = 2 * n;
    double *mat = take(sizeof(double) * dim * dim), *rhs = take(sizeof(double) * dim);
    int *pivot = take(sizeof(int) * dim);
    C *v = take(sizeof(C) * n), *res = take(sizeof(C) * n), *p = take(sizeof(C) * n);
    Q *even = take(sizeof(Q) * nn), *odd = take(sizeof(Q) * nn), root = sqrtq(t->sinf);
    C undir = conjugate(dir);
    for (int parity = 0; parity < 2; parity++) {
        int s = parity ? -1 : 1;
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++) {
                double c = (double)cm[i * n + j], d = (double)dm[i * n + j], ri = (double)r[i], rj = (double)r[j];
                double co = (double)RE(dir), si = (double)IM(dir), wr = (double)RE(w[j]), wi = (double)IM(w[j]);
                double ar = c * co, ai = -c * si, er = d * (rj - ri) * co, ei = d * (rj + ri) * si;
                double pr = ar * wr - ai * wi, pi = ar * wi + ai * wr; /* times V */
                double mr = er * wr + ei * wi, mi = ei * wr - er * wi; /* times conj V */
                double *top = mat + (size_t)(2 * i) * dim + 2 * j, *bot = top + dim;
                top[0] = -s * (pr + mr);
                top[1] = -s * (-pi + mi);
                bot[0] = -s * (pi + mi);
                bot[1] = -s * (pr - mr);
                if (i == j) { top[0] += 1; bot[1] += 1; }
            }
        lu(mat, dim, pivot);
        for (int i = 0; i < n; i++) { v[i] = 0; res[i] = mk(root, 0); }
        for (int step = 0; step < 8; step++) {
            double big = 0, change = 0;
            for (int i = 0; i < n; i++) { big = fmax(big, fmax(fabs((double)RE(res[i])), fabs((double)IM(res[i])))); }
            if (big == 0) break;
            for (int i = 0; i < n; i++) { rhs[2 * i] = (double)(RE(res[i]) / big); rhs[2 * i + 1] = (double)(IM(res[i]) / big); }
            lu_solve(mat, dim, pivot, rhs);
            for (int i = 0; i < n; i++) {
                C dv = scale(big, mk(rhs[2 * i], rhs[2 * i + 1]));
                v[i] += dv;
                change = fmax(change, (double)sqrtq(norm2(dv) / norm2(v[i])));
            }
            ray_steps = step + 1;
            if (change < 1e-22) break;
            for (int j = 0; j < n; j++) p[j] = mul(w[j], v[j]);
            for (int i = 0; i < n; i++) {
                Q ar = 0, ai = 0, br = 0, bi = 0, er = 0, ei = 0;
                for (int j = 0; j < n; j++) {
                    Q c = cm[i * n + j], d = dm[i * n + j], dr = d * RE(p[j]), di = d * IM(p[j]);
                    ar += c * RE(p[j]); ai += c * IM(p[j]);
                    br += dr; bi -= di;
                    er += r[j] * dr; ei -= r[j] * di;
                }
                C sum = mul(undir, mk(ar, ai)) + mul(dir, mk(er, ei)) - scale(r[i], mul(undir, mk(br, bi)));
                res[i] = mk(root, 0) - v[i] + scale(s, sum);
            }
        }
        for (int j = 0; j < n; j++) p[j] = mul(w[j], v[j]);
        for (int k = 0; k < nn; k++) {
            Q z = sqrtq(2 * (1 + cosq(M_PIq * (2 * k + 1) / (2 * nn))));
            C vz = mk(root, 0);
            for (int j = 0; j < n; j++) {
                C zeta = scale(r[j], dir);
                vz += scale(s, mul(p[j], inverse(zeta + mk(z, 0))) + mul(conjugate(p[j]), inverse(conjugate(zeta) - mk(z, 0))));
            }
            C q = mk(z / x, 0), out = mul(mul(cexponential(mk(0, z)), factor(t, &b0, q)), vz);
            Q sz = RE(symbol(t, q));
            if (parity) odd[k] = IM(out) / sz / z; else even[k] = RE(out) / sz;
        }
    }
    Q a0 = 0, a1 = 0, b1 = 0, b2 = 0;
    for (int m = 0; m < nn; m++) {
        Q ce = 0, co = 0;
        for (int k = 0; k < nn; k++) {
            Q tk = cosq(M_PIq * m * (2 * k + 1) / (2 * nn)) * (m ? 2 : 1) / nn;
            ce += tk * even[k];
            co += tk * odd[k];
        }
        int sign = m % 2 ? -1 : 1;
        a0 += sign * ce; b1 += sign * co;
        a1 -= sign * ce * m * m / 2; b2 -= sign * co * m * m / 2;
    }
    Values out;
    out.gamma = a0 / t->sinf;
    out.delta0 = -2 * a1 / a0;
    out.eeq = a0 * b1 / t->sinf;
    out.pi0 = 8 * (a0 * b2 - a1 * b1) / t->sinf;
    free(r); free(w); free(cm); free(dm); free(mat); free(rhs); free(pivot); free(v); free(res); free(p); free(even); free(odd);
    free(b.t2); free(b.tl); free(b0.t2); free(b0.tl);
    return out;
}

/* Any material. S(0) = 0: the answer is analytic in an added compliance of the sphere, so extrapolate it to zero. */
static Values wiener_hopf(const Material *t, Q x, const RayRule *rule) {
    if (t->s0 > 0) return wiener_hopf_elastic(t, x, rule);
    enum { ORDER = 5 };
    Q unit = 1e-5Q * RE(symbol(t, mk(1 / x, 0))), choose = 1;
    Values sum = {0, 0, 0, 0};
    for (int k = 1; k <= ORDER; k++) {
        choose = choose * (ORDER - k + 1) / k;
        Material soft = *t;
        soft.sphere += k * unit;
        soft.s0 += k * unit;
        soft.sinf += k * unit;
        Values v = wiener_hopf_elastic(&soft, x, rule);
        Q w = k % 2 ? choose : -choose;
        sum.pi0 += w * v.pi0;
        sum.eeq += w * v.eeq;
        sum.gamma += w * v.gamma;
        sum.delta0 += w * v.delta0;
    }
    return sum;
}

/* ---------------------------------------------------------------- one row */

static const GalerkinRule G1 = {12, 9.5, 24, 12, 3, 28}, G2 = {14, 10.5, 30, 14, 2.5, 30};

/* Each level differs from the one before in angle, cut-offs, step and interpolation. */
static const RayRule W[] = {{27, 20.5, 16}, {25, 22, 17}, {28, 24.5, 18}, {26, 27, 17}, {27.5, 29, 18}};
enum { LEVELS = sizeof W / sizeof *W };

static const double RAY_FROM = 0.1, GALERKIN_TO = 60, GALERKIN_TO_RIGID = 150, GOOD = 1e-18, FAIR = 1e-17;

/* The values, the digits to which two computations agree, and which two. */
static Values best(Q x, const Material *t, int *agreed, const char **how) {
    Values a, b;
    double error;
    if (x <= (t->s0 > 0 ? GALERKIN_TO : GALERKIN_TO_RIGID)) {
        a = galerkin(t, x, &G2);
        *how = "GW";
        error = 1;
        if (x >= RAY_FROM)
            for (int level = 1; level < LEVELS && error > GOOD; level++) error = disagreement(a, wiener_hopf(t, x, &W[level]));
        if (error > FAIR) {
            double ray = error;
            error = disagreement(a, galerkin(t, x, &G1));
            *how = x < RAY_FROM ? "GG" : ray < 1e-12 ? "GGw" : "GG?";
        }
    } else {
        *how = "WW";
        a = wiener_hopf(t, x, &W[0]);
        error = 1;
        for (int level = 1; level < LEVELS && error > GOOD; level++) {
            b = a;
            a = wiener_hopf(t, x, &W[level]);
            error = disagreement(a, b);
        }
    }
    *agreed = digits(error);
    return a;
}

static const char *text(Q v, char *out, size_t size) { quadmath_snprintf(out, size, "%.19Qe", v); return out; }

static void show(const char *name, Values v) {
    char s[4][64];
    printf("%s %s %s %s %s\n", name, text(v.pi0, s[0], 64), text(v.eeq, s[1], 64), text(v.gamma, s[2], 64), text(v.delta0, s[3], 64));
}

static double seconds(void) { return (double)clock() / CLOCKS_PER_SEC; }

static int point(char **arg) {
    double p[5];
    for (int i = 0; i < 5; i++) p[i] = strtod(arg[i], NULL);
    Material t = material(p[1], p[2], p[3], p[4]);
    Values g1, g2, w, before;
    memset(&g2, 0, sizeof g2);
    double start = seconds();
    if (p[0] <= 150) {
        g1 = galerkin(&t, p[0], &G1); show("G1", g1); printf("   %.2f s\n", seconds() - start); start = seconds();
        g2 = galerkin(&t, p[0], &G2); show("G2", g2); printf("   %.2f s, G1-G2 %.2e\n", seconds() - start, disagreement(g1, g2));
    }
    for (int i = 0; i < LEVELS; i++) {
        start = seconds();
        w = wiener_hopf(&t, p[0], &W[i]);
        show("W ", w);
        printf("   %.2f s, %d points, %d on the branch, %d steps", seconds() - start, ray_points, branch_points, ray_steps);
        if (i) printf(", from last %.2e", disagreement(w, before));
        if (p[0] <= 150) printf(", from G2 %.2e", disagreement(w, g2));
        printf("\n");
        before = w;
    }
    return 0;
}

/* Recomputes the rows of a csv without `kind` whose inputs are the printed decimals themselves, not the doubles nearest to them. */
static int check(int files, char **name) {
    int bad = 0;
    for (int f = 0; f < files; f++) {
        FILE *in = fopen(name[f], "r");
        if (!in) { perror(name[f]); return 1; }
        char line[1000];
        int rows = 0, least = 99;
        while (fgets(line, sizeof line, in)) {
            if (!strchr("0123456789", *line)) continue;
            char *at = line;
            double claimed;
            Q p[5], v[4];
            for (int i = 0; i < 5; i++) { p[i] = strtoflt128(at, &at); at++; }
            for (int i = 0; i < 4; i++) { v[i] = strtoflt128(at, &at); at++; }
            claimed = strtod(at, NULL);
            Material t = material(p[1], p[2], p[3], p[4]);
            int own;
            const char *how;
            Values mine = best(p[0], &t, &own, &how), theirs = {v[0], v[1], v[2], v[3]};
            double error = disagreement(mine, theirs);
            int found = digits(error), expected = claimed < own ? (int)claimed : own;
            rows++;
            if (found - expected < least) least = found - expected;
            if (found >= expected - 1) continue;
            bad++;
            printf("%s: %d digits, claimed %g, own %d (%s): %s", name[f], found, claimed, own, how, line);
        }
        fclose(in);
        printf("%s: %d rows, least digits beyond min(claimed, own): %d\n", name[f], rows, least);
    }
    return bad != 0;
}

/* ---------------------------------------------------------------- the list of points */

static int failures;

static void row(const char *kind, const char *x, const char *e1, const char *nu1, const char *e0, const char *nu0) {
    Material t = material(strtod(e1, NULL), strtod(nu1, NULL), strtod(e0, NULL), strtod(nu0, NULL));
    int agreed;
    const char *how;
    double start = seconds();
    Values v = best(strtod(x, NULL), &t, &agreed, &how);
    char s[4][64];
    fprintf(stderr, "%s %d %.2f s: %s,%s,%s,%s,%s\n", how, agreed, seconds() - start, x, e1, nu1, e0, nu0);
    if (agreed < 15) { failures++; return; }
    printf("%s,%s,%s,%s,%s,%s,%s,%s,%s,%s,%d\n", kind, x, e1, nu1, e0, nu0, text(v.pi0, s[0], 64), text(v.eeq, s[1], 64),
           text(v.gamma, s[2], 64), text(v.delta0, s[3], 64), agreed);
    fflush(stdout);
}

static uint64_t state = 20240607;

static double uniform(double lo, double hi) { /* splitmix64 */
    uint64_t z = state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return lo + (hi - lo) * ((double)((z ^ (z >> 31)) >> 11) * 0x1p-53);
}

static void randoms(int count) {
    for (int i = 0; i < count; i++) {
        char x[32], e1[32], nu1[32], e0[32], nu0[32];
        double range = uniform(0, 1), lx = uniform(0, 1), k1 = uniform(0, 1), l1 = uniform(-8, 8), kn = uniform(0, 1);
        double n1 = uniform(0, 0.5), k0 = uniform(0, 1), l0 = uniform(-6, 10), n0 = uniform(0, 0.5);
        sprintf(x, "%.6g", pow(10, range < 0.45 ? -2 + 5 * lx : -6 + 12 * lx));
        sprintf(e1, "%.6g", k1 < 0.05 ? 0 : pow(10, l1));
        sprintf(nu1, "%.6g", kn < 0.15 ? 0.5 : n1);
        sprintf(e0, "%.6g", k0 < 0.15 ? INFINITY : pow(10, l0));
        sprintf(nu0, "%.6g", n0);
        if (i % 50 == 7) strcpy(nu1, "0.499999999999");
        if (i % 50 == 17) strcpy(nu1, "0.4999");
        if (i % 50 == 27) sprintf(nu1, "%.6g", -1.8 * n1);
        if (i % 50 == 37) sprintf(nu0, "%.6g", -1.8 * n0);
        if (i % 50 == 47) strcpy(nu0, "0.5");
        row("random", x, e1, nu1, e0, nu0);
    }
}

static void corners(void) {
    static const char *const ALL[] = {"1e-6", "1e-3", "1", "10", "25", "40", "100", "1e3", "1e6", NULL};
    static const char *const FEW[] = {"1e-3", "1", "25", "100", "1e6", NULL};
    static const char *const BIG[] = {"1", "10", "40", "100", "1e3", "1e6", NULL};
    static const struct { const char *const *x, *e1, *nu1, *e0, *nu0; } LIST[] = {
        /* rigid sphere; film incompressible or not, substrate rigid or nearly so */
        {ALL, "0", "0.5", "inf", "0"}, {ALL, "0", "0.5", "1e10", "0.5"}, {ALL, "0", "0", "inf", "0"},
        /* stiff sphere */
        {ALL, "1e-8", "0.5", "inf", "0"}, {ALL, "1e-8", "0.5", "1e10", "0"}, {ALL, "1e-8", "0.5", "1", "0.5"},
        /* stiff film on a soft substrate */
        {ALL, "1e8", "0", "1e-6", "0.5"}, {ALL, "1e8", "0.5", "1e-6", "0"}, {ALL, "0", "0.5", "1e-6", "0"},
        /* equal Young's moduli */
        {ALL, "1", "0", "1", "0.5"}, {ALL, "1", "0.5", "1", "0"},
        /* nearly or wholly equal */
        {FEW, "1", "0.3", "1.000001", "0.3"}, {FEW, "1", "0.3", "1", "0.300001"}, {FEW, "1", "0.3", "1", "0.3"},
        /* nearly incompressible */
        {BIG, "1e-8", "0.499999999999", "inf", "0"}, {BIG, "1e-8", "0.4999", "inf", "0"},
        /* others */
        {FEW, "1e8", "0.5", "inf", "0"}, {FEW, "1e8", "0", "1e10", "0.5"}, {FEW, "1", "0.5", "inf", "0"}, {FEW, "1e-8", "0", "1e-6", "0"},
        {FEW, "1e-8", "-0.9", "inf", "0"}, {FEW, "1e8", "0.5", "1e-6", "-0.9"},
    };
    for (size_t i = 0; i < sizeof LIST / sizeof *LIST; i++)
        for (const char *const *x = LIST[i].x; *x; x++) row("corner", *x, LIST[i].e1, LIST[i].nu1, LIST[i].e0, LIST[i].nu0);
}

int main(int argc, char **argv) {
    if (argc == 7 && !strcmp(argv[1], "point")) return point(argv + 2);
    if (argc > 2 && !strcmp(argv[1], "check")) return check(argc - 2, argv + 2);
    int count = argc > 1 ? atoi(argv[1]) : 500;
    printf(
        "# Reference values of Pi0, Eeq, Gamma, Delta0, computed by contacts_quad.c beside this file in quadruple precision (113 bits).\n"
        "# a/t <= 60 (150 if both bodies are rigid): even-Legendre Galerkin, compared with Wiener-Hopf where a/t >= 0.1, otherwise with\n"
        "# Galerkin at other modes and quadrature. Larger a/t: Wiener-Hopf, compared with itself at another angle, step and cut-off.\n"
        "# Where that comparison falls short of 17 digits below those limits, the two Galerkin runs are compared instead.\n"
        "# digits_agreed is the comparison, for the worst of the four quantities, at most 20 (what is printed).\n"
        "# e1_over_e2, e0_over_e2: Young's modulus over the sphere's reduced modulus E2*. e1_over_e2 = 0: rigid sphere, everything is\n"
        "# normalised by the film's reduced modulus E1* and e0_over_e2 is E0/E1. e0_over_e2 = inf: rigid substrate.\n"
        "# The inputs are the doubles nearest to the printed decimals. Rows of kind `random` first, then `corner`.\n"
        "kind,a_over_t,e1_over_e2,nu1,e0_over_e2,nu0,pi0,eeq,gamma,delta0,digits_agreed\n");
    randoms(count);
    corners();
    fprintf(stderr, "%d points left out, %.0f s\n", failures, seconds());
    return failures != 0;
}
