#include "Quads/SurfaceQuads.h"

#include "FieldSolver.h"
#include "Quads/Crosses/AlignedEdges.h"
#include "Quads/LengthsOfEdges.h"
#include "Quads/QuadRemedies.h"
#include "Quads/SizesOfQuads.h"

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace dmg
{

namespace
{

/// The weight of features that edges of quads shall run along.
constexpr double WeightOfAligned = 1000.0;

/// \pre the surface lives longer than the pointer.
std::shared_ptr<const FramedMesh> Borrowed(const FramedMesh& surface)
{
  return { std::shared_ptr<void>(), &surface };
}

/// Fills the faces without a direction with the smoothest field that agrees with the others.
Vector<Complex> FilledGaps(
  const FramedMesh& surface, const Vector<Complex>& powers, const ExecutionContext& context, const ElementNames& names)
{
  FieldSolver solver(Borrowed(surface));
  FieldProblem problem;
  for (int face = 0; face < powers.size(); ++face)
  {
    if (powers[face] != 0.0)
    {
      const Complex direction = std::polar(1.0, 0.25 * std::arg(powers[face]));
      problem.Constraints.OnFaces.push_back({ face, surface.Faces.ToVector(face, direction), WeightOfAligned });
    }
  }
  const Vector<Complex> smooth = FourthPowers(solver.Solve(problem, context, names).OnFaces);
  Vector<Complex> filled = powers;
  for (int face = 0; face < powers.size(); ++face)
  {
    filled[face] = powers[face] != 0.0 ? powers[face] : smooth[face];
  }
  return filled;
}

/// A solver of fields on the surface that quads are made of, in whose metric quads of the lengths that are wanted are alike.
FieldSolver SolverInMetric(const FramedMesh& surface, const FinerSurface* finer, const QuadOptions& options)
{
  const FramedMesh& fine = finer ? finer->Geometry : surface;
  const bool areEven = options.Sizes.size() == 0 || options.Sizes.maxCoeff() == options.Sizes.minCoeff();
  if (areEven)
  {
    return FieldSolver(Borrowed(fine));
  }
  const Vector<double> lengths =
    FindLengthsOfEdges(fine.Mesh, FaceComponents(fine.Mesh), finer ? OptionsOf(options, *finer) : options).OnFaces;
  return FieldSolver(Borrowed(fine), AtVertices(fine.Mesh, lengths));
}

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

QuadMesh MakeQuadsAlongFeatures(
  const FramedMesh& surface, const QuadOptions& asked, const ExecutionContext& context, const ElementNames& names)
{
  const QuadOptions options = WithSizesAlone(surface, asked, names, PartOfContext(context, 0.0, 0.0));
  std::shared_ptr<const FinerSurface> finer =
    SurfaceForQuads(surface, options, PartOfContext(context, 0.0, 0.05), names);
  FieldSolver solver = SolverInMetric(surface, finer.get(), options);
  FieldProblem problem;
  problem.Features.BoundaryWeight = options.AlignBoundary ? WeightOfAligned : 0.0;
  if (options.AlignSharpEdges)
  {
    problem.Constraints.OnFaces = AlongSharpLines(solver.Surface(), options, WeightOfAligned);
  }
  const std::vector<Constraint> borders =
    AlongBorders(solver.Surface(), finer ? OptionsOf(options, *finer) : options, WeightOfAligned);
  problem.Constraints.OnFaces.insert(problem.Constraints.OnFaces.end(), borders.begin(), borders.end());
  problem.UnitLengthWhileSmoothing = true;
  const Field& field = *WithRemedyOfQuads(
    [&] { return &solver.Solve(problem, PartOfContext(context, 0.05, 0.3), finer ? finer->NamesOf(names) : names); });
  const Vector<Complex> powers = FourthPowers(field.OnFaces);
  return MakeQuads(surface, std::move(finer), powers, options, PartOfContext(context, 0.3, 1.0), names);
}

QuadMesh MakeQuadsAcrossGaps(const FramedMesh& surface, const Vector<Complex>& powers, const QuadOptions& options,
  const ExecutionContext& context, const ElementNames& names)
{
  const bool hasGaps = powers.size() == surface.Mesh.NumberOfFaces() && (powers.array() == 0.0).any();
  return MakeQuads(surface,
    hasGaps ? WithRemedyOfQuads([&] { return FilledGaps(surface, powers, PartOfContext(context, 0.0, 0.2), names); })
            : powers,
    options, PartOfContext(context, hasGaps ? 0.2 : 0.0, 1.0), names);
}

}
