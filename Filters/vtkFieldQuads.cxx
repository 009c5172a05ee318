#include "vtkFieldQuads.h"

#include "Adapters/Input/CrossesOfSurface.h"
#include "Adapters/Output/QuadsToPolyData.h"
#include "Adapters/Pipeline/FilterOutputs.h"
#include "Adapters/Pipeline/PanelWords.h"
#include "Adapters/Pipeline/PropertyRanges.h"
#include "Adapters/Surface/PolygonsFromDataSet.h"
#include "Adapters/View/ChosenArrays.h"
#include "Quads/QuadMesh.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <string>

vtkStandardNewMacro(vtkFieldQuads);

namespace
{

/// The chosen relative lengths of edges, by face; empty where none are chosen.
dmg::Vector<double> SizesOf(const dmg::ChosenArray& choice, const dmg::SurfaceView& view)
{
  const dmg::ChosenArray chosen = dmg::FindArray(choice, view.Given(), 1, "sizes", "the surface");
  const dmg::TriangleMesh& mesh = view.Mesh();
  dmg::Vector<double> sizes(chosen.Array ? mesh.NumberOfFaces() : 0);
  for (int face = 0; face < sizes.size(); ++face)
  {
    double sum = 0.0;
    for (int h = 3 * face; h < 3 * face + 3; ++h)
    {
      sum += chosen.Array->GetComponent(
        chosen.OnPoints() ? view.Relation().PointOf(mesh.Tail(h)) : view.Relation().CellOf(face), 0);
    }
    sizes[face] = sum / 3.0;
  }
  return sizes;
}

std::string SummaryOf(const dmg::QuadMesh& mesh)
{
  return std::to_string(mesh.Quads.size()) + " quads, " + std::to_string(mesh.Report.IrregularVertices) +
    " irregular vertices, " + std::to_string(mesh.Report.InvertedQuads) + " inverted";
}

std::string SentenceOf(const dmg::QuadReport& report, std::size_t quads)
{
  std::string sentence;
  if (!report.RefinedFaces.empty())
  {
    sentence += "edges are shorter on " + std::to_string(report.RefinedFaces.size()) +
      " triangles, where a handle, a hole or a component would be lost, which makes " + std::to_string(quads) +
      " quads. ";
  }
  if (report.SplitFaces > 0)
  {
    sentence += std::to_string(report.SplitFaces) +
      " triangles, of components with few of them, were split into quads that follow no field. ";
  }
  if (report.LeftOut > 0)
  {
    sentence += std::to_string(report.LeftOut) + " pairs of triangles back to back are left out. ";
  }
  if (report.CutOff > 0)
  {
    sentence += "thin parts at the boundary may be lost at " + std::to_string(report.CutOff / 2) + " places. ";
  }
  if (report.InvertedQuads > 0)
  {
    sentence += std::to_string(report.InvertedQuads) + " quads are inverted; see ScaledJacobian. ";
  }
  return sentence.empty() ? sentence : sentence.substr(0, sentence.size() - 1);
}

}

//------------------------------------------------------------------------------
vtkFieldQuads::vtkFieldQuads()
{
  this->SetNumberOfOutputPorts(3);
}

//------------------------------------------------------------------------------
int vtkFieldQuads::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const auto output = [outputVector](int port) { return vtkPolyData::GetData(outputVector, port); };
  this->Summary.clear();
  const auto make = [&](vtkInformationVector** whole, const dmg::ExecutionContext& context)
  {
    dmg::CheckRanges({
      { "Number Of Quads", this->NumberOfQuads, 1, 900000 },
      { "Edge Length", this->EdgeLength, 0, 1e40 },
      { "Number Of Directions", this->NumberOfDirections, 0, 8 },
      { "Feature Angle", this->FeatureAngle, 0, 180 },
      { "Smoothing Steps", this->SmoothingSteps, 0, 1000 },
      { "Ball Radius", this->BallRadius, 0, 10 },
    });
    dmg::QuadOptions options;
    options.NumberOfQuads = this->NumberOfQuads;
    options.EdgeLength = this->EdgeLength;
    options.AlignBoundary = this->AlignBoundary;
    options.AlignSharpEdges = this->AlignSharpEdges;
    options.FeatureAngle = this->FeatureAngle;
    options.SmoothingSteps = this->SmoothingSteps;
    dmg::SurfaceView view(dmg::SurfaceOf(whole[0]));
    const dmg::Vector<dmg::Complex> crosses =
      dmg::CrossesOf(this, view, this->NumberOfDirections, options, dmg::PartOfContext(context, 0.0, 0.3));
    options.Sizes = SizesOf(dmg::ChoiceOf(this, 1), view);
    const dmg::QuadMesh quads = dmg::MakeQuads(
      view.Surface().Geometry, crosses, options, dmg::PartOfContext(context, 0.3, 1.0), view.Relation().Names());
    dmg::MapToPolyData(quads, view, output(1));
    if (!quads.Report.Error.empty())
    {
      vtkErrorMacro(<< dmg::InPanelWords(quads.Report.Error));
      return;
    }
    this->Summary = SummaryOf(quads);
    dmg::QuadsToPolyData(quads, view, output(0));
    dmg::IrregularToPolyData(quads, this->BallRadius, output(2));
    dmg::Warn(this, { SentenceOf(quads.Report, quads.Quads.size()) });
  };
  return dmg::MakeOutputs(this, request, inputVector, outputVector, make);
}

//------------------------------------------------------------------------------
const char* vtkFieldQuads::GetSummary() const
{
  return this->Summary.c_str();
}

//------------------------------------------------------------------------------
void vtkFieldQuads::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfQuads: " << this->NumberOfQuads << "\n";
  os << indent << "EdgeLength: " << this->EdgeLength << "\n";
  os << indent << "AlignBoundary: " << (this->AlignBoundary ? "On" : "Off") << "\n";
  os << indent << "AlignSharpEdges: " << (this->AlignSharpEdges ? "On" : "Off") << "\n";
  os << indent << "FeatureAngle: " << this->FeatureAngle << "\n";
  os << indent << "SmoothingSteps: " << this->SmoothingSteps << "\n";
  os << indent << "BallRadius: " << this->BallRadius << "\n";
}
