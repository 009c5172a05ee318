#include "vtkFieldGlyphs.h"

#include "Adapters/Input/FieldFromArrays.h"
#include "Adapters/Output/DrawingToPolyData.h"
#include "Adapters/Pipeline/PropertyTable.h"
#include "Drawing/FieldGlyphs.h"
#include "Drawing/GlyphPlaces.h"

#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <vector>

vtkStandardNewMacro(vtkFieldGlyphs);

//------------------------------------------------------------------------------
dmg::PropertyTable vtkFieldGlyphs::Properties() const
{
  dmg::PropertyTable table;
  table.Choice("Placement", this->Placement, { "EvenlySpread", "EveryTriangle" });
  table.Number("SeparatingDistance", this->SeparatingDistance, 0.0005, 1);
  table.Choice("Sizing", this->Sizing, { "Even", "ByTriangle", "ByMagnitude" });
  table.Number("ScaleFactor", this->ScaleFactor, 0.01, 100);
  table.Choice("Style", this->Style, { "Solid", "Strokes" });
  table.Number("Width", this->Width, 0.005, 0.3);
  table.Number("Lift", this->Lift, 0, 0.1);
  return table;
}

//------------------------------------------------------------------------------
int vtkFieldGlyphs::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* const output = vtkPolyData::GetData(outputVector);
  return dmg::DrawField(
    this, request, inputVector, outputVector, this->NumberOfDirections, [this] { return this->Properties(); },
    [this, output](const dmg::SurfaceWithField& given, const dmg::ExecutionContext& context)
    {
      dmg::GlyphPlaceOptions where;
      where.Placement = static_cast<dmg::GlyphPlacement>(this->Placement);
      where.Distance = this->SeparatingDistance * given.Diagonal;
      where.Sizing = static_cast<dmg::GlyphSizing>(this->Sizing);
      where.Scale = this->ScaleFactor;
      dmg::GlyphOptions how;
      how.Form = this->Style == Solid ? dmg::GlyphOptions::Shape::Solid : dmg::GlyphOptions::Shape::Strokes;
      how.Width = this->Width;
      how.Lift = this->Lift * given.Diagonal;
      const dmg::UnfoldedSurface surface(given.View.Mesh(), given.View.Surface().Geometry.Faces, context);
      const std::vector<dmg::GlyphPlace> places =
        dmg::PlaceGlyphs(surface, given.Field, where, dmg::PartOfContext(context, 0.0, 0.6));
      const dmg::GlyphsOnSurface glyphs =
        dmg::FieldGlyphs(surface, given.Field, places, how, dmg::PartOfContext(context, 0.6, 0.9));
      dmg::GlyphsToPolyData(glyphs, given.Field.NumberOfFamilies(), this->Style == Strokes,
        given.View.Surface().Geometry, how.Lift, output, dmg::PartOfContext(context, 0.9, 1.0));
    });
}

//------------------------------------------------------------------------------
void vtkFieldGlyphs::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->Properties().Print(os, indent);
}
