#ifndef dmgTypes_h
#define dmgTypes_h

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/SparseCore>

#include <complex>
#include <vector>

/// The numerical core of DirectionalMultigrid. It knows no VTK.
namespace dmg
{

using Complex = std::complex<double>;
using Complex32 = std::complex<float>; ///< parts of 32 bits

constexpr double Pi = EIGEN_PI;

using Vector2 = Eigen::Vector2d;
using Vector3 = Eigen::Vector3d;

/// #V x 3, one point per row.
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// #F x 3, the corners of a triangle per row, counter-clockwise seen from outside.
using Triangles = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;

template <class Scalar>
using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

/// Compressed rows with 32-bit indices, column indices ascending in each row.
template <class Scalar>
using SparseMatrix = Eigen::SparseMatrix<Scalar, Eigen::RowMajor, int>;

}

#endif
