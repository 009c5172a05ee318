#include "Adapters/Output/WarningsOfQuads.h"

#include "Support/ShortText.h"

#include <algorithm>
#include <cmath>

namespace dmg
{

namespace
{

/// Why quads are other than asked for.
std::string ReasonOf(const QuadReport& report, bool areMany)
{
  return report.SplitFaces > 0     ? "triangles were split"
    : report.IsShortened           ? "larger ones do not fit a handle, a hole or a component"
    : !report.RefinedFaces.empty() ? "larger ones would lose parts of the surface"
    : areMany                      ? "each component, singularity and aligned line takes some"
                                   : "singularities and aligned lines leave no room for more";
}

/// The number of quads or the length of their edges, where it is not the one that was asked for.
std::string OfNumber(const QuadMesh& mesh, const QuadOptions& options)
{
  constexpr double Tolerance = 0.1;
  const double made = static_cast<double>(mesh.Quads.size()), length = mesh.Report.MeanLength;
  if (options.EdgeLength > 0.0)
  {
    return std::abs(length / options.EdgeLength - 1.0) <= Tolerance
      ? std::string()
      : "edges of quads are " + ShortText(length) + " long on average rather than " + ShortText(options.EdgeLength) +
        ", as " + ReasonOf(mesh.Report, length < options.EdgeLength);
  }
  return std::abs(made / options.NumberOfQuads - 1.0) <= Tolerance
    ? std::string()
    : "there are " + std::to_string(mesh.Quads.size()) + " quads rather than " + ShortText(options.NumberOfQuads) +
      ", as " + ReasonOf(mesh.Report, made > options.NumberOfQuads);
}

std::string OfRefinement(const QuadReport& report)
{
  return report.RefinedFaces.empty() ? std::string()
                                     : "edges are shorter on " + std::to_string(report.RefinedFaces.size()) +
      " triangles, where a handle, a hole, a component or a limb would be lost";
}

std::string OfSplitting(const QuadReport& report)
{
  std::string text;
  if (report.SplitFaces > 0)
  {
    text = std::to_string(report.SplitFaces) +
      " triangles, of components with few of them, were split into quads that follow no field";
  }
  if (report.LeftOut > 0)
  {
    text += std::string(text.empty() ? "" : "; ") + std::to_string(report.LeftOut) +
      " pairs of triangles back to back are left out";
  }
  return text;
}

/// Parts of the surface that quads do not reach.
std::string OfLosses(const QuadReport& report, const QuadOptions& options, bool hasBoundary, const ElementNames& names)
{
  const std::string remedy = std::string("; ask for more of them") +
    (!hasBoundary               ? ""
        : options.AlignBoundary ? ", or switch Align Boundary off"
                                : ", or switch Align Boundary on");
  constexpr double FarInEdges = 1.0, LeastShare = 0.85;
  const QuadDistances& distances = report.Distances;
  if (distances.FarthestVertex >= 0 && distances.InEdges > FarInEdges)
  {
    return "quads are up to " + ShortText(distances.LargestFromQuads) + " away from the surface, " +
      ShortText(distances.InEdges) + " edges, at " + names.Vertex(distances.FarthestVertex) + remedy;
  }
  const double least = *std::min_element(report.AreaShares.begin(), report.AreaShares.end());
  if (least < LeastShare && least > 0.0)
  {
    return "quads have " + ShortText(std::round(100.0 * least)) + " % of the area of the component of " +
      names.Face(report.LeastCovered) + remedy;
  }
  return report.CutOff > 0
    ? "thin parts at the boundary may be lost at " + std::to_string(report.CutOff / 2) + " places"
    : std::string();
}

/// Sizes that were given are compared. Those by curvature are a wish that varies more than quads can; they are compared where another field helps.
std::string OfSizes(const QuadReport& report, const QuadOptions& options, bool isFieldGiven)
{
  constexpr double Least = 0.9;
  if (report.ReachedRatio >= Least * report.AskedRatio || (options.Adaptivity > 0.0 && !isFieldGiven))
  {
    return {};
  }
  const auto rounded = [](double ratio) { return ShortText(0.01 * std::round(100.0 * ratio)); };
  return "sizes vary by " + rounded(report.AskedRatio) + ", and lengths of edges by " + rounded(report.ReachedRatio) +
    (isFieldGiven ? ", as the given field is kept; without one, a field is found that turns with the sizes"
                  : ", as singularities and aligned lines allow");
}

std::string OfDeviation(const QuadReport& report, const QuadOptions& options)
{
  return report.AgainstField.empty() ? std::string()
                                     : "quads follow " + std::to_string(report.AgainstField.size()) +
      " edges of the boundary or between regions that are off the field by more than " +
      ShortText(options.LargestDeviation) + " degrees; to keep the field, switch Align Boundary off" +
      (options.Regions.empty() ? "" : " and choose no Regions");
}

std::string OfSymmetry(const QuadReport& report)
{
  if (report.IsSymmetric || report.Asymmetry == 0.0)
  {
    return {};
  }
  return report.Asymmetry > LargestAsymmetry
    ? "quads are not symmetric, as the surface is off its mirror image by " + ShortText(100.0 * report.Asymmetry) +
      " % of the diagonal of its box, more than " + ShortText(100.0 * LargestAsymmetry) + " %"
    : "quads are not symmetric, as cells lie in the plane of symmetry, or the cut "
      "there touches itself; choose another plane, or none";
}

std::string OfRegions(const QuadReport& report)
{
  return report.LostRegions > 0
    ? std::to_string(report.LostRegions) + " regions are smaller than quads and have none; ask for more quads"
    : std::string();
}

std::string OfInversion(const QuadReport& report)
{
  return report.InvertedQuads > 0 ? std::to_string(report.InvertedQuads) + " quads are inverted; see ScaledJacobian"
                                  : std::string();
}

}

std::vector<std::string> WarningsOf(
  const QuadMesh& mesh, const QuadOptions& options, bool isFieldGiven, const ElementNames& names)
{
  const bool hasBoundary = std::find(mesh.IsOnBoundary.begin(), mesh.IsOnBoundary.end(), 1) != mesh.IsOnBoundary.end();
  return { OfNumber(mesh, options), OfRefinement(mesh.Report), OfSplitting(mesh.Report),
    OfLosses(mesh.Report, options, hasBoundary, names), OfSizes(mesh.Report, options, isFieldGiven),
    OfDeviation(mesh.Report, options), OfInversion(mesh.Report), OfSymmetry(mesh.Report), OfRegions(mesh.Report) };
}

}
