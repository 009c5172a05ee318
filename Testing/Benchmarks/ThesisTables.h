#ifndef dmgBenchmarksThesisTables_h
#define dmgBenchmarksThesisTables_h

#include <array>
#include <limits>

/// What the thesis printed, tables 7.8 to 7.18. Times in milliseconds, on its author's machine.
namespace dmg::benchmarks::thesis
{

inline constexpr double Failed = std::numeric_limits<double>::quiet_NaN();

/// Of one mesh and one discretisation: coarse prolongation (CP), nested iterations (NI) and
/// Cholesky. "Energy" is the thesis's word for the mass-weighted residual.
struct Solves
{
  double CoarseEnergy, CoarseError, NestedEnergy, NestedError;
  double CholeskyPrepare, CholeskySolve, MultigridPrepare, CoarseSolve, NestedSolve;
};

struct Mesh
{
  const char* File; ///< stem of the file that stands for it
  const char* Name;
  int Faces;
  double Setup;
  std::array<Solves, 3> Of; ///< DEC, face-based, power with N = 2
};

inline constexpr std::array<Mesh, 12> Meshes = { {
  { "t01_bunny_deformed", "Bunny Deformed", 278710, 9473576,
    { { { 1.03, 0.502, 0.0178, 0.276, 12002, 90, 6106, 24, 1765 },
      { 0.972, 0.502, 0.0035, 0.0483, 80006, 288, 11465, 36, 2759 },
      { 1.02, 0.619, 0.00648, 0.0622, 8420, 77, 7868, 32, 1773 } } } },
  { "t02_armadillo", "Armadillo", 174568, 3717574,
    { { { 1.02, 0.415, 0.0202, 0.197, 2269, 42, 3837, 13, 1114 },
      { 0.958, 0.675, 0.00399, 0.0494, 15858, 130, 6722, 20, 1748 },
      { 1.01, 0.61, 0.00563, 0.0662, 1722, 37, 4871, 19, 1244 } } } },
  { "t03_santa", "Santa", 151558, 2474853,
    { { { 1.04, 0.866, 0.0438, 0.783, 1488, 36, 2557, 10, 953 },
      { 0.96, 0.637, 0.00455, 0.0454, 11136, 106, 5079, 17, 1518 },
      { 1.02, 0.542, 0.00776, 0.0619, 1124, 30, 2771, 13, 899 } } } },
  { "t04_nefertiti_for_ramses", "Ramses", 100000, 1133211,
    { { { 1.02, 0.922, 0.046, 0.809, 1186, 24, 2411, 8, 839 },
      { 0.981, 0.738, 0.00489, 0.0575, 8617, 71, 4236, 13, 1497 },
      { 0.998, 0.633, 0.00694, 0.076, 773, 20, 3333, 13, 688 } } } },
  { "t05_chair", "Chair", 99968, 895905,
    { { { 1.02, 0.849, 0.0426, 0.647, 1611, 25, 2049, 7, 641 },
      { 0.935, 0.484, 0.00627, 0.045, 10995, 73, 3659, 12, 1078 },
      { 0.993, 0.498, 0.00723, 0.0656, 950, 20, 2100, 10, 601 } } } },
  { "t06_owl", "Owl", 74538, 649464,
    { { { 1.01, 0.766, 0.0315, 0.56, 1167, 20, 1496, 7, 530 },
      { 0.939, 0.518, 0.00489, 0.0452, 9289, 59, 2897, 10, 726 },
      { 1.01, 0.419, 0.00762, 0.0496, 780, 16, 1766, 8, 457 } } } },
  { "t07_igea_for_old_face", "Old Face", 55448, 343663,
    { { { 1, 0.469, 0.0169, 0.218, 854, 15, 941, 5, 336 },
      { Failed, Failed, Failed, Failed, Failed, Failed, Failed, Failed, Failed },
      { 1.02, 0.545, 0.00617, 0.0658, 632, 12, 1283, 6, 325 } } } },
  { "t08_ball", "Ball", 31438, 101058,
    { { { 0.917, 0.485, 0.0945, 0.0693, 560, 9, 938, 4, 201 }, { 0.905, 0.43, 0.00537, 0.0455, 4462, 28, 2088, 6, 341 },
      { 1.01, 0.418, 0.00669, 0.0756, 430, 7, 1207, 5, 178 } } } },
  { "t09_bunny_big", "Bunny Big", 111364, 1500470,
    { { { 1.01, 0.4743, 0.0198, 0.253, 2412, 30, 2591, 9, 734 },
      { Failed, Failed, Failed, Failed, Failed, Failed, Failed, Failed, Failed },
      { 1.02, 0.583, 0.00636, 0.0607, 1708, 26, 4300, 19, 845 } } } },
  { "t10_bunny_small", "Bunny Small", 13584, 24528,
    { { { 0.941, 0.5, 0.0188, 0.249, 59, 2, 255, 2, 68 }, { 0.909, 0.446, 0.00368, 0.0433, 384, 7, 493, 3, 114 },
      { 1, 0.376, 0.00586, 0.0594, 46, 2, 345, 2, 68 } } } },
  { "t11_lucy", "Lucy", 100000, 1168947,
    { { { 1.02, 0.956, 0.0466, 0.881, 853, 22, 1924, 8, 739 }, { 0.99, 0.808, 0.0109, 0.101, 6255, 65, 3488, 11, 1597 },
      { 0.998, 0.525, 0.00827, 0.0682, 560, 18, 2394, 10, 688 } } } },
  { "t12_lucy_remeshed", "Lucy Remeshed", 109592, 1405326,
    { { { 1.03, 0.909, 0.0398, 0.826, 1230, 27, 2192, 8, 714 },
      { 0.903, 0.431, 0.00531, 0.0386, 8679, 76, 3895, 12, 1080 },
      { 1.01, 0.686, 0.00624, 0.0663, 784, 21, 2632, 11, 770 } } } },
} };

/// V-cycles to an error of 1e-3 on Bunny Deformed, by sweeps per level.
struct Cycles
{
  int Number;
  double PerCycle;
};
inline constexpr std::array<std::array<Cycles, 8>, 3> CyclesBySweeps = { {
  { { { 148, 137 }, { 75, 211 }, { 50, 285 }, { 38, 359 }, { 31, 433 }, { 26, 507 }, { 23, 580 }, { 21, 649 } } },
  { { { 21, 233 }, { 12, 375 }, { 9, 515 }, { 8, 634 }, { 7, 764 }, { 6, 881 }, { 6, 1024 }, { 6, 1130 } } },
  { { { 16, 168 }, { 9, 259 }, { 7, 349 }, { 6, 438 }, { 5, 528 }, { 5, 613 }, { 5, 691 }, { 5, 785 } } },
} };

/// Nested iterations for power fields on Bunny Deformed, by starting level, the coarsest first.
struct Start
{
  double Error, Prepare, Solve;
};
inline constexpr std::array<Start, 3> Starts = { {
  { 0.0633, 8209, 1741 },
  { 0.0633, 10131, 1579 },
  { 0.0633, 34252, 1200 },
} };

}

#endif
