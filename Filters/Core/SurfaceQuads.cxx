#include "SurfaceQuads.h"

#include "FieldSolver.h"
#include "Quads/Crosses/AlignedEdges.h"

#include <utility>

namespace dmg
{

namespace
{

/// The weight of features that edges of quads shall run along.
constexpr double WeightOfAligned = 1000.0;

}

Vector<Complex> FourthPowers(const Vector<Complex>& directions)
{
  Vector<Complex> powers(directions.size());
  for (Eigen::Index face = 0; face < directions.size(); ++face)
  {
    const double length = std::abs(directions[face]);
    powers[face] = length > 0.0 ? std::pow(directions[face] / length, 4) : Complex(0.0);
  }
  return powers;
}

QuadMesh MakeQuadsAlongFeatures(const std::shared_ptr<const FramedMesh>& surface, const QuadOptions& options,
  const ExecutionContext& context, const ElementNames& names)
{
  std::shared_ptr<const FinerSurface> finer =
    SurfaceForQuads(*surface, options, PartOfContext(context, 0.0, 0.05), names);
  FieldSolver solver(finer ? std::shared_ptr<const FramedMesh>(finer, &finer->Geometry) : surface);
  FieldProblem problem;
  problem.Features.BoundaryWeight = options.AlignBoundary ? WeightOfAligned : 0.0;
  if (options.AlignSharpEdges)
  {
    problem.Constraints.OnFaces = AlongSharpLines(solver.Surface(), options, WeightOfAligned);
  }
  problem.UnitLengthWhileSmoothing = true;
  const Field& field = solver.Solve(problem, PartOfContext(context, 0.05, 0.3), finer ? finer->NamesOf(names) : names);
  const Vector<Complex> powers = FourthPowers(field.OnFaces);
  return MakeQuads(*surface, std::move(finer), powers, options, PartOfContext(context, 0.3, 1.0), names);
}

}
