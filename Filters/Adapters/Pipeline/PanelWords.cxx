#include "Adapters/Pipeline/PanelWords.h"

#include "vtkAlgorithm.h"

#include <array>
#include <utility>

namespace dmg
{

namespace
{

/// Turns faces and cuts the surface, but along creases.
const std::string Normals = "Generate Surface Normals (vtkPolyDataNormals) with Consistency and Splitting on, "
                            "Feature Angle 180 and Non-Manifold Traversal off";

const std::string Operators = "apply Directional Prolongation (vtkDirectionalProlongation) with ";

/// Names of files and arrays stand in quotes. What they have beyond a hundred characters hides the sentence around them.
std::string WithShortNames(std::string message)
{
  constexpr std::size_t Longest = 100;
  for (std::size_t begin = message.find(" '"); begin != std::string::npos; begin = message.find(" '", begin + 2))
  {
    const std::size_t end = message.find('\'', begin + 2);
    if (end != std::string::npos && end - begin - 2 > Longest)
    {
      message.replace(begin + 2 + Longest, end - begin - 2 - Longest, "...");
    }
  }
  return message;
}

}

std::string PanelTextOf(Remedy remedy)
{
  // The order is that of the enumeration.
  static const std::array<std::string, static_cast<std::size_t>(Remedy::Count)> Texts{
    "Number Of Directions",
    "Feature Angle",
    "Boundary Weight",
    "Sharp Edges Weight",
    "Curvature Weight",
    "set Constraint Type to Soft",
    "Rotation and Rotation Array have no effect, as the field follows nothing; choose Guides or Directions, or set "
    "them to 0 and None",
    "Rotation",
    "Maximum Distance",
    "Maximum Source Distance",
    "Smoothing Length",
    "choose Power Field at Points (PointPowerField) as Discretisation",
    "Guides",
    "by Mask or a direction of zero where there is no mask",
    "choose Power Field at Points as Discretisation, or take the input Singularities away",
    "choose Conjugate Gradients as Solver",
    "Maximum Number Of Iterations",
    "switch Harmonic Basis off",
    "switch Strict off",
    "Separating Distance",
    "Separating Distance",
    "choose Evenly Spread as Placement",
    "Net Source",
    "choose an array of points for Values, and a Mask and Weights that are not zero everywhere",
    "by Mask or a value of NaN where there is no mask",
    Operators + "Power Fields on",
    Operators + "Face Fields on",
    Operators + "One Forms on",
    "make it larger with Transform (vtkTransformPolyDataFilter)",
    "make the whole surface smaller with Transform (vtkTransformPolyDataFilter)",
    "apply Extract Surface (vtkGeometryFilter) and Triangulate (vtkTriangleFilter) first",
    "reduce the number of triangles with Decimate (vtkDecimatePro)",
    "apply Clean (vtkCleanPolyData), then Triangulate (vtkTriangleFilter)",
    "apply Clean (vtkCleanPolyData), which merges them and drops the cell",
    "apply Clean (vtkCleanPolyData) with a Tolerance of 1e-12, which merges them and drops the cell",
    "apply Clean (vtkCleanPolyData), which drops unused points",
    "remove one of them with Clean to Grid, Clean Cells to Grid and Extract Surface (vtkRemoveDuplicatePolys)",
    Normals,
    "apply " + Normals +
      "; a surface with one side only, like a Moebius strip, is cut by a Feature Angle of 60 or less",
    "remove triangles without area with Cell Size, Threshold of Area and Extract Surface (vtkCellSizeFilter, "
    "vtkThreshold, vtkGeometryFilter)",
    "triangulate its points anew, in a plane with Delaunay 2D (vtkDelaunay2D)",
    "with Calculator (vtkArrayCalculator) for example",
  };
  return Texts[static_cast<std::size_t>(remedy)];
}

std::string InPanelWords(std::string message)
{
  for (int k = 0; k < static_cast<int>(Remedy::Count); ++k)
  {
    const std::string from = TextOf(static_cast<Remedy>(k));
    const std::string to = PanelTextOf(static_cast<Remedy>(k));
    for (std::size_t at = message.find(from); at != std::string::npos; at = message.find(from, at + to.size()))
    {
      message.replace(at, from.size(), to);
    }
  }
  return WithShortNames(std::move(message));
}

void Warn(vtkAlgorithm* algorithm, const std::vector<std::string>& texts)
{
  for (const std::string& text : texts)
  {
    if (!text.empty())
    {
      vtkWarningWithObjectMacro(algorithm, << InPanelWords(text));
    }
  }
}

}
