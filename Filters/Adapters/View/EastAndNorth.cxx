#include "Adapters/View/EastAndNorth.h"

#include "Mesh/Globe.h"
#include "Mesh/PositiveSide.h"
#include "Support/Errors.h"

#include "vtkDataArray.h"

#include <sstream>

namespace dmg
{

Vector3 EastAndNorth::At(vtkIdType tuple, const Vector3& place) const
{
  double components[2]; // GetTuple may be called by several threads, GetComponent of any array may not
  this->Eastward.Array->GetTuple(tuple, components);
  this->Northward.Array->GetTuple(tuple, components + 1);
  const GlobeDirections at = DirectionsOnGlobe(this->Axis, place);
  return components[0] * at.East + components[1] * at.North;
}

Vector3 UnitAxis(const Vector3& axis, const std::string& another)
{
  if (axis.isZero(0.0) || !axis.allFinite())
  {
    std::ostringstream text;
    text << "Axis is (" << axis[0] << ", " << axis[1] << ", " << axis[2]
         << "), which has no direction; give it another value" << another;
    throw InvalidInput(text.str());
  }
  return (axis / axis.cwiseAbs().maxCoeff()).normalized();
}

std::string ProblemOfComponents(const Points& positions)
{
  return positions.rows() > 0 && HaveConstantZ(positions)
    ? "the surface is a plane, and eastward and northward components need a globe around the origin; choose vectors, "
      "made of them with Calculator (vtkArrayCalculator) for example"
    : "";
}

EastAndNorth FindEastAndNorth(const ChosenArray& eastward, const ChosenArray& northward, const Vector3& axis,
  vtkDataSet* dataset, const std::string& whose)
{
  const ChosenArray east = FindArray(eastward, dataset, 1, "eastward component", whose);
  const ChosenArray north = FindArray(northward, dataset, 1, "northward component", whose);
  if (!east.Array && !north.Array)
  {
    return {};
  }
  if (!east.Array || !north.Array || east.Association != north.Association)
  {
    const std::string chosen = east.Array ? "eastward" : "northward", other = east.Array ? "northward" : "eastward";
    throw InvalidInput("the " + chosen + " component is chosen, and no " + other +
      " component of the same points or cells; choose both");
  }
  return { east, north, UnitAxis(axis) };
}

}
