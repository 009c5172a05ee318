#include "Adapters/Output/WarningsOfQuads.h"

#include "Support/ShortText.h"

#include <algorithm>
#include <cmath>

namespace dmg
{

namespace
{

/// The number of quads, where it is not the one that was asked for.
std::string OfNumber(const QuadMesh& mesh, const QuadOptions& options)
{
  constexpr double Tolerance = 0.1;
  const double made = static_cast<double>(mesh.Quads.size());
  if (options.EdgeLength > 0.0 || std::abs(made / options.NumberOfQuads - 1.0) <= Tolerance)
  {
    return {};
  }
  const QuadReport& report = mesh.Report;
  const std::string reason = report.SplitFaces > 0 ? "triangles were split"
    : report.IsShortened                           ? "larger ones do not fit a handle, a hole or a component"
    : !report.RefinedFaces.empty()                 ? "larger ones would lose parts of the surface"
    : made > options.NumberOfQuads                 ? "each component, singularity and aligned line takes some"
                                                   : "singularities and aligned lines leave no room for more";
  return "there are " + std::to_string(mesh.Quads.size()) + " quads rather than " + ShortText(options.NumberOfQuads) +
    ", as " + reason;
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

std::string OfSizes(const QuadReport& report)
{
  constexpr double Least = 0.9;
  return report.ReachedRatio >= Least * report.AskedRatio
    ? std::string()
    : "sizes vary by " + ShortText(report.AskedRatio) + ", and lengths of edges by " + ShortText(report.ReachedRatio) +
      ", as a field that was made for equal sizes allows";
}

std::string OfInversion(const QuadReport& report)
{
  return report.InvertedQuads > 0 ? std::to_string(report.InvertedQuads) + " quads are inverted; see ScaledJacobian"
                                  : std::string();
}

}

std::vector<std::string> WarningsOf(const QuadMesh& mesh, const QuadOptions& options, const ElementNames& names)
{
  const bool hasBoundary = std::find(mesh.IsOnBoundary.begin(), mesh.IsOnBoundary.end(), 1) != mesh.IsOnBoundary.end();
  return { OfNumber(mesh, options), OfRefinement(mesh.Report), OfSplitting(mesh.Report),
    OfLosses(mesh.Report, options, hasBoundary, names), OfSizes(mesh.Report), OfInversion(mesh.Report) };
}

}
