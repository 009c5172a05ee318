#ifndef dmgSeamlessMap_h
#define dmgSeamlessMap_h

#include "Mesh/FramedMesh.h"
#include "Quads/Crosses/CrossField.h"
#include "Quads/Map/IntegerLattice.h"
#include "Quads/Map/SeamlessVariables.h"
#include "Solvers/Direct/CholeskySolver.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <array>
#include <memory>
#include <vector>

namespace dmg
{

/// Numbers of the map in fixed point: multiples of 2^-20. Turns by right angles, shifts by integers and halves are exact.
using FixedPoint = long long;
constexpr FixedPoint FixedOne = 1LL << 20;

/// The coordinates u and v of each corner of each face, by halfedge at its tail. Never a half-integer.
using MapOfCorners = std::vector<std::array<FixedPoint, 2>>;

/// The sign of twice the area of a face in the map: 1, -1 where it is turned over, or 0.
int OrientationInMap(const MapOfCorners& map, int face);
/// The number of faces of an orientation in the map.
int NumberOfFaces(const MapOfCorners& map, int orientation);

/// A seamless integer map whose gradients are near to the directions of a cross field.
///
/// It has the least energy, the sum over faces of area times |grad u - g_u|^2 + |grad v - g_v|^2, where g_u and g_v are directions 0 and
/// 1 over the length of edges that is wanted. The energy is quadratic in the real unknowns r and the parameters y of the integers:
///
///   r^T H_rr r + 2 r^T H_ry y + y^T H_yy y - 2 b_r^T r - 2 b_y^T y.
///
/// H_rr is factored once. With the best r for each y, the energy is that of y alone, with the Schur complement
/// S = H_yy - H_ry^T H_rr^-1 H_ry, and ClosestIntegers finds y without another solve. All of this stays for other lengths of edges.
/// Components of the surface have parameters of their own: S is a block of each, and one solve serves a parameter of every component.
class SeamlessMap
{
public:
  /// Cost: one factor, and a solve per parameter of the integers that a component has; n^3 for its n.
  SeamlessMap(const FramedMesh& surface, const CrossField& field, SeamlessVariables variables,
    const ExecutionContext& context = SerialContext());

  /// Finds the map for the lengths of edges that are wanted. No triangle is kept from turning over; a dozen steps that limit the
  /// distortion (local/global, with the same factor and integers) bring most of them back.
  /// \param lengths by face, > 0.
  MapOfCorners Map(const Vector<double>& lengths, const ExecutionContext& context = SerialContext());

  /// The area in the plane of the real map, whose integers are not rounded, for these lengths: the number of quads to expect. It is
  /// proportional to 1 / length^2.
  double AreaOfRealMap(const Vector<double>& lengths, const ExecutionContext& context = SerialContext());

private:
  using Targets = std::vector<std::array<Complex, 2>>; ///< by face, the gradients that are wanted

  /// The parameters of the integers of one component.
  struct ParametersOfComponent
  {
    std::vector<int> Numbers; ///< in ascending order
    Eigen::MatrixXd Schur;
    Eigen::MatrixXd InverseOfSchur;
  };

  void Assemble(const ExecutionContext& context);
  /// \param Z the integer part of each corner by parameters.
  void GroupParameters(const SparseMatrix<double>& Z);
  /// H_yy = Z^T K Z, into Schur.
  void AddEnergyOfIntegers(
    const SparseMatrix<double>& Z, const SparseMatrix<double>& K, const ExecutionContext& context);
  void FindSchurComplement(const ExecutionContext& context);
  /// The gradient of the hat function of corner k of a face, times twice its area.
  Complex HatGradient(int face, int k) const;
  Targets FromField(const Vector<double>& lengths, const ExecutionContext& context) const;
  /// The nearest maps with singular values in a range, to those at hand.
  Targets LimitedDistortion(
    const Vector<double>& corners, const Vector<double>& lengths, const ExecutionContext& context) const;
  Vector<double> RightSide(const Targets& targets, const ExecutionContext& context) const;
  /// The best y without rounding.
  Vector<double> RealParameters(const Vector<double>& right, Vector<double>& reals);
  void SolveReals(const Vector<double>& right, const Vector<double>& parameters, Vector<double>& reals);
  Vector<double> CornersOf(const Vector<double>& reals, const Vector<double>& parameters) const;
  MapOfCorners InFixedPoint(const Vector<double>& reals, const Vector<double>& parameters) const;
  MapOfCorners LimitDistortion(MapOfCorners map, Vector<double> reals, const Vector<double>& parameters,
    const Vector<double>& lengths, const ExecutionContext& context);

  const CrossField& Field;
  const TriangleMesh& Mesh;
  const SeamlessVariables Variables;
  SparseMatrix<double> Lattice;                   ///< z = Lattice y
  std::vector<Complex> Sides;                     ///< by halfedge, in the frame of the face
  Vector<double> Areas;                           ///< twice those of faces, raised for thin ones
  Vector<double> Weights;                         ///< of faces: their area over the raised one
  SparseMatrix<double> RealsByIntegers;           ///< H_ry
  std::unique_ptr<CholeskySolver<double>> Factor; ///< of H_rr
  std::vector<ParametersOfComponent> Parameters;
};

}

#endif
