#include "vtkFieldLines.h"

#include "Adapters/Input/FieldFromArrays.h"
#include "Adapters/Output/DrawingToPolyData.h"
#include "Adapters/Pipeline/PropertyTable.h"
#include "Drawing/EvenlySpacedLines.h"

#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <cmath>
#include <sstream>
#include <vector>

vtkStandardNewMacro(vtkFieldLines);

namespace
{

constexpr double SmallestDistance = 0.0005;
constexpr double HeadSpacing = 8.0; // over the distance between lines
constexpr double HeadSize = 0.6;

/// The number, rounded down to two digits.
double RoundedDown(double number)
{
  const double unit = number > 0.0 ? std::pow(10.0, std::floor(std::log10(number)) - 1.0) : 1.0;
  return unit * std::floor(number / unit);
}

}

//------------------------------------------------------------------------------
dmg::PropertyTable vtkFieldLines::Properties() const
{
  dmg::PropertyTable table;
  table.Number("SeparatingDistance", this->SeparatingDistance, SmallestDistance, 1);
  table.Number("SeparatingDistanceRatio", this->SeparatingDistanceRatio, 0.05, 0.9);
  table.Number("MinimumLength", this->MinimumLength, 0, 1000);
  table.Number("Lift", this->Lift, 0, 0.1);
  table.Switch("ArrowHeads", this->ArrowHeads);
  return table;
}

//------------------------------------------------------------------------------
int vtkFieldLines::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* const output = vtkPolyData::GetData(outputVector);
  return dmg::DrawField(
    this, request, inputVector, outputVector, this->NumberOfDirections, [this] { return this->Properties(); },
    [this, output](const dmg::SurfaceWithField& given, const dmg::ExecutionContext& context)
    {
      dmg::LineOptions options;
      options.Separation = this->SeparatingDistance * given.Diagonal;
      options.StopRatio = this->SeparatingDistanceRatio;
      options.MinimumLength = this->MinimumLength * options.Separation;
      const dmg::UnfoldedSurface surface(given.View.Mesh(), given.View.Surface().Geometry.Faces, context);
      const dmg::LinesOnSurface lines =
        dmg::EvenlySpacedLines(surface, given.Field, options, dmg::PartOfContext(context, 0.0, 0.9));
      const auto heads = this->ArrowHeads && given.Field.N() == 1
        ? dmg::ArrowHeadsOf(
            lines, given.View.Surface().Geometry.Faces, HeadSpacing * options.Separation, HeadSize * options.Separation)
        : std::vector<dmg::ArrowHead>();
      dmg::LinesToPolyData(lines, heads, given.View.Surface().Geometry, this->Lift * given.Diagonal, output,
        dmg::PartOfContext(context, 0.9, 1.0));
      if (lines.NumberOfLines() == 0)
      {
        // Lines have other places at another distance, and the longest is half as long there at least. With MinimumLength 0
        // only what is no line at all is left out.
        const double distance = this->MinimumLength > 0.0
          ? RoundedDown(0.5 * lines.LongestLeftOut / (this->MinimumLength * given.Diagonal))
          : 0.0;
        std::ostringstream nearer;
        if (distance >= SmallestDistance)
        {
          nearer << "Separating Distance " << distance << " (in Directional Field, Line Distance) or ";
        }
        vtkWarningMacro("no line is as long as Minimum Length, "
          << this->MinimumLength << ", times Separating Distance, " << this->SeparatingDistance
          << " of the surface's size; " << nearer.str() << "Minimum Length "
          << RoundedDown(lines.LongestLeftOut / options.Separation) << " would do");
      }
    });
}

//------------------------------------------------------------------------------
void vtkFieldLines::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->Properties().Print(os, indent);
}
