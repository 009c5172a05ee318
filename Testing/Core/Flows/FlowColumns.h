#ifndef dmgTestFlowColumns_h
#define dmgTestFlowColumns_h

#include "Mesh/FramedMesh.h"
#include "Support/Types.h"

#include <cmath>

/// Flows on faces as columns of pairs of real numbers.
namespace dmg::test
{

/// Rows times the square root of the area, so that products of columns are integrals.
inline Eigen::MatrixXd Weighted(const FramedMesh& surface, Eigen::MatrixXd columns)
{
  const Vector<double> areas = surface.Mesh.FaceAreas();
  for (int row = 0; row < columns.rows(); ++row)
  {
    columns.row(row) *= std::sqrt(areas[row / 2]);
  }
  return columns;
}

inline Eigen::MatrixXd Turned(const Eigen::MatrixXd& columns)
{
  Eigen::MatrixXd turned(columns.rows(), columns.cols());
  for (int row = 0; row < columns.rows(); row += 2)
  {
    turned.row(row) = -columns.row(row + 1);
    turned.row(row + 1) = columns.row(row);
  }
  return turned;
}

}

#endif
