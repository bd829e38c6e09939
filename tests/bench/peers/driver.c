/* Evaluates a generated derivative at the samples of a file:
     driver FILE values   prints the derivatives, each with the Jacobian of a peer that has it
     driver FILE count    evaluates once, for callgrind
     driver FILE time     prints nanoseconds per evaluation, the median of some rounds
   The file: numbers of parameters, states, inputs and samples, then parameters, then states and inputs. */
#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

void peer(const double *p, const double *x, const double *u, double *dx);

/* a peer with a Jacobian has a function of its own for this */
__attribute__((weak)) void print_jacobian(void) {}

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return t.tv_sec * 1e9 + t.tv_nsec;
}

static int ascending(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

int main(int argc, char **argv) {
  FILE *file = argc == 3 ? fopen(argv[1], "r") : NULL;
  int np, nx, nu, ns;
  if (!file || fscanf(file, "%d %d %d %d", &np, &nx, &nu, &ns) != 4) return 1;
  size_t row = (size_t)(nx + nu);
  double *p = malloc(sizeof(double) * (size_t)(np + 1)), *dx = malloc(sizeof(double) * (size_t)nx);
  double *samples = malloc(sizeof(double) * row * (size_t)ns);
  for (int i = 0; i < np; i++) if (fscanf(file, "%lf", p + i) != 1) return 1;
  for (size_t i = 0; i < row * (size_t)ns; i++) if (fscanf(file, "%lf", samples + i) != 1) return 1;
  if (!strcmp(argv[2], "time")) {
    enum { ROUNDS = 101, PASSES = 40 };
    double rounds[ROUNDS];
    for (int round = 0; round < ROUNDS; round++) {
      double start = now();
      for (int pass = 0; pass < PASSES; pass++)
        for (int s = 0; s < ns; s++) {
          const double *x = samples + row * (size_t)s;
          peer(p, x, x + nx, dx);
        }
      rounds[round] = (now() - start) / (PASSES * ns);
    }
    qsort(rounds, ROUNDS, sizeof(double), ascending);
    printf("%.17g\n", rounds[ROUNDS / 2]);
    return 0;
  }
  for (int s = 0; s < ns; s++) {
    const double *x = samples + row * (size_t)s;
    peer(p, x, x + nx, dx);
    if (!strcmp(argv[2], "values")) {
      for (int i = 0; i < nx; i++) printf("%.17g\n", dx[i]);
      print_jacobian();
    }
  }
  return 0;
}
