#ifndef dmgAllIndices_h
#define dmgAllIndices_h

#include <Eigen/Core>

namespace dmg
{

// All rows or all columns of a matrix, as in A(rows, All). Eigen 3.4 has Eigen::all and deprecates Eigen::placeholders::all; since
// then there is the latter alone.
#if EIGEN_VERSION_AT_LEAST(3, 4, 90)
inline const auto All = Eigen::placeholders::all;
#else
inline const auto All = Eigen::all;
#endif

}

#endif
