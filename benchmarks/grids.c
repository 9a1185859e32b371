/* The loose grid's queries and pairs once more in C, to see what its compiler makes of them.
   The same loops over the same arrays as benchmarks/arena.py; int64 slots and cells. */

#include <stdint.h>

#define REACH 0.8

static int64_t touched(const double *x, const double *y, const int64_t *nexts, int64_t slot, double qx, double qy)
{
    int64_t count = 0;
    while (slot) {
        double dx = x[slot] - qx, dy = y[slot] - qy;
        if (dx * dx + dy * dy < REACH * REACH)
            count++;
        slot = nexts[slot];
    }
    return count;
}

int64_t loose_queries(int64_t columns, const double *x, const double *y, const int64_t *heads, const int64_t *nexts,
                      const double *qx, const double *qy, int64_t queries)
{
    int64_t count = 0;
    for (int64_t k = 0; k < queries; k++) {
        int64_t cell = ((int64_t)qy[k] + 1) * (columns + 2) + (int64_t)qx[k] + 1;
        for (int64_t row = -1; row < 2; row++)
            for (int64_t column = -1; column < 2; column++)
                count += touched(x, y, nexts, heads[cell + row * (columns + 2) + column], qx[k], qy[k]);
    }
    return count;
}

static int64_t pairs_with(const double *x, const double *y, const int64_t *nexts, int64_t first, int64_t second)
{
    return touched(x, y, nexts, second, x[first], y[first]);
}

int64_t five_cell_pairs(int64_t columns, const double *x, const double *y, const int64_t *heads, const int64_t *nexts,
                        const int64_t *cells, int64_t slots)
{
    int64_t count = 0, below = columns + 2;
    for (int64_t first = 1; first < slots; first++) {
        int64_t cell = cells[first];
        count += pairs_with(x, y, nexts, first, nexts[first]);
        count += pairs_with(x, y, nexts, first, heads[cell + 1]);
        for (int64_t neighbour = cell + below - 1; neighbour < cell + below + 2; neighbour++)
            count += pairs_with(x, y, nexts, first, heads[neighbour]);
    }
    return count;
}

int64_t brute_queries(const double *x, const double *y, int64_t slots, const double *qx, const double *qy,
                      int64_t queries)
{
    int64_t count = 0;
    for (int64_t k = 0; k < queries; k++)
        for (int64_t slot = 1; slot < slots; slot++) {
            double dx = x[slot] - qx[k], dy = y[slot] - qy[k];
            if (dx * dx + dy * dy < REACH * REACH)
                count++;
        }
    return count;
}
