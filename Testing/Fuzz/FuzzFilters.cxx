// Random surfaces, arrays, operators and options through the filters: they crash, hang and tell nonsense on none.
//
//   FuzzFilters [--cases n] [--seconds s] [--first seed] [--corpus file]
//
// A case is made from its seed alone, a number; a corpus is a list of seeds. A case fails where an output that is not empty
// holds a number that is not finite or where there is neither an output nor an error; the seed is written before it runs,
// into FuzzFilters.seed beside the program, so that it is known after a crash.

#include "vtkHarmonicFieldSolver.h"
#include "vtkHodgeDecomposition.h"

#include "Cxx/TestTools.h"
#include "Fuzz/Choices.h"
#include "Fuzz/OtherData.h"
#include "Fuzz/TimeSeries.h"

#include "vtkDirectionalProlongation.h"
#include "vtkFieldAngles.h"
#include "vtkFieldGlyphs.h"
#include "vtkFieldLines.h"
#include "vtkFieldQuads.h"
#include "vtkFieldSingularities.h"
#include "vtkFieldWriter.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkParallelTransport.h"
#include "vtkPrincipalDirections.h"
#include "vtkScaleFilter.h"
#include "vtkSurfaceDistance.h"
#include "vtkUnstructuredGrid.h"

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iostream>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <utility>

using namespace dmg;
using namespace dmg::test;

namespace
{

Surface ShapeOf(Choices& choose)
{
  switch (choose.Below(8))
  {
    case 0:
      return Icosphere(choose.Below(4));
    case 1:
      return IrregularTorus(3 + choose.Below(20), 3 + choose.Below(12), choose.Below(1000));
    case 2:
      return IrregularPlane(1 + choose.Below(20), 1 + choose.Below(12), choose.Below(1000));
    case 3:
      return SphereWithZeroAreaFaces(2, 1 + choose.Below(6));
    case 4:
      return PlaneWithThinTriangles(4 + choose.Below(10), 2 + choose.Below(8));
    case 5:
      return choose.OneIn(2) ? MoebiusStrip(3 + choose.Below(9)) : PinchedTetrahedra();
    case 6:
      return PerforatedSlab(1 + choose.Below(3), 1 + choose.Below(2), 1);
    default:
    {
      Surface soup{ Points(3 + choose.Below(12), 3), Triangles(1 + choose.Below(14), 3) };
      for (int i = 0; i < soup.V.size(); ++i)
      {
        soup.V.data()[i] = choose.Below(4);
      }
      for (int i = 0; i < soup.F.size(); ++i)
      {
        soup.F.data()[i] = choose.Below(static_cast<int>(soup.V.rows()));
      }
      return soup;
    }
  }
}

vtkSmartPointer<vtkPolyData> SurfaceOf(Choices& choose)
{
  Surface shape = ShapeOf(choose);
  if (choose.OneIn(4)) // another size or shape
  {
    const int axis = choose.Below(4);
    const double factor = std::pow(10.0, choose.Below(90) - 45.0);
    axis == 3 ? void(shape.V *= factor) : void(shape.V.col(axis) *= factor);
  }
  if (choose.OneIn(6))
  {
    shape.F.row(choose.Below(static_cast<int>(shape.F.rows()))).reverseInPlace();
  }
  for (int changes = choose.OneIn(3) ? choose.Below(4) : 0; changes > 0; --changes)
  {
    shape.V(choose.Below(static_cast<int>(shape.V.rows())), choose.Below(3)) = choose.Number();
  }
  const auto surface = PolyDataOf(shape, choose.OneIn(2) ? VTK_FLOAT : VTK_DOUBLE);
  if (choose.OneIn(10))
  {
    surface->GetPolys()->InsertNextCell({ 0, 1, 2, choose.Below(9) - 2 });
  }
  if (choose.OneIn(10))
  {
    vtkNew<vtkCellArray> verts;
    verts->InsertNextCell({ 0 });
    surface->SetVerts(verts);
  }
  return surface;
}

vtkSmartPointer<vtkDataArray> ArrayOf(Choices& choose, const char* name, vtkIdType tuples, int components)
{
  vtkSmartPointer<vtkDataArray> array;
  switch (choose.Below(4))
  {
    case 0:
      array = vtkSmartPointer<vtkFloatArray>::New();
      break;
    case 1:
      array = vtkSmartPointer<vtkIntArray>::New();
      break;
    default:
      array = vtkSmartPointer<vtkDoubleArray>::New();
  }
  array->SetName(name);
  array->SetNumberOfComponents(choose.OneIn(20) ? 1 + choose.Below(9) : components);
  array->SetNumberOfTuples(choose.OneIn(20) ? choose.Below(30) : tuples);
  const bool isSparse = choose.OneIn(2);
  const bool isInteger = array->GetDataType() == VTK_INT;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    const bool isZero = isSparse && !choose.OneIn(10);
    for (int k = 0; k < array->GetNumberOfComponents(); ++k)
    {
      const double ordinary = choose.OneIn(40) ? choose.Number() : 2.0 * choose.Unit() - 0.5;
      array->SetComponent(i, k, isZero ? 0.0 : isInteger ? choose.Below(3) : ordinary);
    }
  }
  return array;
}

void AddArrays(Choices& choose, vtkDataSet* data)
{
  for (vtkDataSetAttributes* const attributes : { static_cast<vtkDataSetAttributes*>(data->GetPointData()),
         static_cast<vtkDataSetAttributes*>(data->GetCellData()) })
  {
    const vtkIdType tuples = attributes == data->GetCellData() ? data->GetNumberOfCells() : data->GetNumberOfPoints();
    attributes->AddArray(ArrayOf(choose, "Given", tuples, 3));
    attributes->AddArray(ArrayOf(choose, "Mask", tuples, 1));
    attributes->AddArray(ArrayOf(choose, "Weights", tuples, 1));
    attributes->AddArray(ArrayOf(choose, "Values", tuples, 1));
  }
}

/// Some numbers of some hidden arrays.
void Damage(Choices& choose, vtkFieldData* operators)
{
  for (int changes = choose.Below(4); changes > 0 && operators->GetNumberOfArrays() > 0; --changes)
  {
    vtkAbstractArray* const any = operators->GetAbstractArray(choose.Below(operators->GetNumberOfArrays()));
    auto* const array = vtkDataArray::SafeDownCast(any);
    if (choose.OneIn(6))
    {
      operators->RemoveArray(any->GetName());
    }
    else if (array && array->GetNumberOfTuples() > 0)
    {
      const int place = choose.Below(static_cast<int>(array->GetNumberOfTuples()));
      array->SetComponent(
        place, 0, array->GetDataType() == VTK_DOUBLE ? choose.Number() : choose.Below(1 << choose.Below(30)) - 1.0);
    }
  }
}

vtkSmartPointer<vtkPolyData> WithOperators(Choices& choose, vtkPolyData* surface)
{
  vtkNew<vtkDirectionalProlongation> filter;
  const Messages messages(filter);
  filter->SetInputData(surface);
  filter->SetMinimumNumberOfFaces(4 + choose.Below(100));
  filter->SetMaximumNumberOfCoarseLevels(choose.Below(4));
  filter->SetFaceRatio(choose.Unit());
  filter->SetCollapsePolicy(choose.Below(2));
  filter->SetConstruction(choose.OneIn(6) ? 1 : 0);
  filter->SetFaceFields(choose.OneIn(2));
  filter->SetOneForms(choose.OneIn(2));
  filter->Update();
  if (messages.Error().empty() != (filter->GetOutput()->GetNumberOfCells() > 0 || surface->GetNumberOfCells() == 0))
  {
    throw std::runtime_error("vtkDirectionalProlongation: neither an output nor an error, or both");
  }
  auto output = vtkSmartPointer<vtkPolyData>::New();
  output->DeepCopy(filter->GetOutput()->GetNumberOfCells() > 0 ? filter->GetOutput() : surface);
  if (choose.OneIn(2))
  {
    Damage(choose, output->GetFieldData());
  }
  return output;
}

void SetOptions(Choices& choose, vtkHarmonicFieldSolver* solver)
{
  const int discretisation = choose.Below(4);
  solver->SetDiscretisation(discretisation);
  solver->SetNumberOfDirections(1 + choose.Below(8));
  solver->SetSolver(choose.Below(6));
  solver->SetConstraintType(choose.Below(2));
  solver->SetCoarseSpace(choose.Below(2));
  for (int bound : { 2, 4, 3, 3, 5 }) // five choices that the corpus's seeds were found with
  {
    choose.Below(bound);
  }
  solver->SetUnitLengthWhileSmoothing(choose.Below(6) == 0);
  solver->SetExpectedSolves(1 + choose.Below(1000));
  choose.OneIn(4); // belonged to a former property; the seeds of the corpus keep their cases
  solver->SetMaximumNumberOfIterations(choose.OneIn(4) ? choose.Below(5) : 100);
  solver->SetTolerance(choose.OneIn(4) ? std::abs(choose.Number()) : 1e-8);
  solver->SetUnitLength(choose.OneIn(2));
  solver->SetCombing(choose.OneIn(2));
  solver->SetHarmonicBasis(choose.OneIn(4));
  solver->SetAllDirections(solver->GetUnitLength()); // seeds of the corpus go on as before
  if (choose.OneIn(4))
  {
    solver->SetAlignment(choose.Number());
    if (!choose.OneIn(2))
    {
      choose.Number(); // of an option that is gone: the cases of the corpus keep their numbers
    }
  }
  const char* const names[] = { "Mask", "Given", "Weights", "Values" };
  const int association = choose.Below(2);
  for (int index = 0; index < 4; ++index)
  {
    const bool isNeeded = index == 1 ? discretisation < 3 : index == 3 && discretisation == 3;
    if (isNeeded || choose.OneIn(8))
    {
      solver->SetInputArrayToProcess(index, 0, 0,
        index == 3           ? 0
          : choose.OneIn(30) ? 1 - association
                             : association,
        names[index]);
    }
  }
}

void SetFeatures(Choices& choose, vtkHarmonicFieldSolver* solver)
{
  for (const auto set : { &vtkHarmonicFieldSolver::SetBoundaryWeight, &vtkHarmonicFieldSolver::SetSharpEdgesWeight,
         &vtkHarmonicFieldSolver::SetCurvatureWeight })
  {
    (solver->*set)(choose.OneIn(2) ? 0.0 : choose.OneIn(8) ? choose.Number() : 3.0 * choose.Unit());
  }
  solver->SetFeatureAngle(180.0 * choose.Unit());
  solver->SetCurvatureDirection(choose.Below(2));
  solver->SetCurvatureScale(choose.OneIn(8) ? 100.0 * choose.Unit() : 2.0 * choose.Unit());
  solver->SetRotation(choose.OneIn(2) ? 0.0 : 360.0 * choose.Unit() - 180.0);
  solver->SetInputArrayToProcess(4, 0, 0, choose.Below(2), choose.OneIn(3) ? "Values" : "");
}

/// Points on and beside a surface, often as many as a sphere has of the least index, with an array of indices or without.
vtkSmartPointer<vtkPolyData> SingularitiesOf(Choices& choose, vtkPolyData* surface, int numberOfDirections)
{
  const int size = choose.OneIn(2) ? 2 * numberOfDirections : choose.Below(8);
  vtkNew<vtkPoints> points;
  const auto indices = Zeros("Index", size, 1);
  for (int i = 0; i < size; ++i)
  {
    double place[3];
    surface->GetPoint(choose.Below(static_cast<int>(surface->GetNumberOfPoints())), place);
    place[choose.Below(3)] += choose.OneIn(4) ? choose.Number() : 0.01 * choose.Unit();
    points->InsertNextPoint(place);
    const double index = static_cast<double>(choose.Below(5) - 2) / numberOfDirections;
    indices->SetValue(i, choose.OneIn(40) ? choose.Number() : index);
  }
  auto singularities = vtkSmartPointer<vtkPolyData>::New();
  singularities->SetPoints(points);
  if (choose.OneIn(3))
  {
    singularities->GetPointData()->AddArray(indices);
  }
  return singularities;
}

/// Whether NaN in an array says that there is nothing: no path to a place, or no flow on a cell.
bool MayBeNaN(const std::string& array)
{
  static const std::set<std::string> names = { "GeodesicDistance", "GeodesicAngle", "LogarithmicMap",
    "TextureCoordinates", "GradientPart", "RotationalPart", "HarmonicPart", "Residual", "NormalComponent", "Potential",
    "StreamFunction", "Divergence", "Vorticity", "Distance", "DirectionFromSource", "PathLength", "StraightLength" };
  const auto isScale = [&array](const char* word) { return array.find(word) != std::string::npos; };
  return names.count(array) > 0 || isScale(" below ") || isScale(" above ");
}

/// \param isOtherMesh whether the arrays of the input are handed on as new ones.
/// \throw std::runtime_error an array that the input has not holds a number that is not finite, where NaN does not say that there is nothing.
void CheckNumbers(vtkDataObject* output, vtkPolyData* input, bool isOtherMesh)
{
  for (int kind = 0; kind < vtkDataObject::NUMBER_OF_ATTRIBUTE_TYPES; ++kind)
  {
    vtkFieldData* const arrays = output->GetAttributesAsFieldData(kind);
    vtkFieldData* const given = input->GetAttributesAsFieldData(kind);
    for (int k = 0; arrays && k < arrays->GetNumberOfArrays(); ++k)
    {
      auto* const array = vtkDoubleArray::SafeDownCast(arrays->GetAbstractArray(k));
      vtkAbstractArray* const former = array && given ? given->GetAbstractArray(array->GetName()) : nullptr;
      if (!array || former == array || (isOtherMesh && former))
      {
        continue;
      }
      for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
      {
        const double number = array->GetValue(i);
        if (!std::isfinite(number) && !(std::isnan(number) && MayBeNaN(array->GetName())))
        {
          throw std::runtime_error(std::string(array->GetName()) + " is not finite");
        }
      }
    }
  }
}

/// Whether an output is the input, which goes on to show where no array is chosen that a filter could work on.
bool HandsOn(vtkAlgorithm* filter, vtkDataObject* output, vtkPolyData* input)
{
  const std::string name = filter->GetClassName();
  const auto arraysOf = [](vtkDataObject* data, int kind) { return data->GetAttributes(kind)->GetNumberOfArrays(); };
  return (name == "vtkFieldAngles" || name == "vtkHodgeDecomposition" || name == "vtkScaleFilter") &&
    output->GetNumberOfElements(vtkDataObject::CELL) == input->GetNumberOfCells() &&
    arraysOf(output, vtkDataObject::POINT) == arraysOf(input, vtkDataObject::POINT) &&
    arraysOf(output, vtkDataObject::CELL) == arraysOf(input, vtkDataObject::CELL);
}

/// Where quads cannot be made, there is the map that they would come from.
bool IsMapWithoutQuads(vtkAlgorithm* filter, int port)
{
  return port == 1 && vtkFieldQuads::SafeDownCast(filter);
}

void Run(vtkAlgorithm* filter, vtkPolyData* input)
{
  const Messages messages(filter);
  filter->Update();
  const bool isEmpty = filter->GetOutputDataObject(0)->GetNumberOfElements(vtkDataObject::CELL) == 0;
  if (isEmpty && messages.Error().empty() && input->GetNumberOfCells() > 0 &&
    std::string(filter->GetClassName()) == "vtkHarmonicFieldSolver")
  {
    throw std::runtime_error("neither an output nor an error");
  }
  for (int port = 0; port < filter->GetNumberOfOutputPorts(); ++port)
  {
    vtkDataObject* const output = filter->GetOutputDataObject(port);
    if (!messages.Error().empty() && output->GetNumberOfElements(vtkDataObject::CELL) > 0 &&
      !(port == 0 && HandsOn(filter, output, input)) && !IsMapWithoutQuads(filter, port))
    {
      throw std::runtime_error("an output in spite of " + messages.Error());
    }
    CheckNumbers(output, input, vtkFieldQuads::SafeDownCast(filter));
  }
}

/// The same solver again, with features, or singularities, or both.
void RunWithFeatures(Choices& choose, vtkHarmonicFieldSolver* solver, vtkPolyData* input)
{
  SetFeatures(choose, solver);
  if (choose.OneIn(2))
  {
    solver->SetDiscretisation(choose.OneIn(8) ? choose.Below(4) : 0);
    solver->SetInputData(2, SingularitiesOf(choose, input, solver->GetNumberOfDirections()));
    solver->SetSingularityIndexArray(choose.OneIn(20) ? "Values" : "");
  }
  Run(solver, input);
  if (choose.OneIn(4) && solver->GetNumberOfInputConnections(2) > 0)
  {
    solver->RemoveAllSingularities();
    Run(solver, input);
  }
}

void Draw(Choices& choose, std::initializer_list<vtkAlgorithm*> filters, vtkPolyData* field)
{
  for (vtkAlgorithm* const drawing : filters)
  {
    drawing->SetInputDataObject(field);
    if (choose.OneIn(3))
    {
      drawing->SetInputArrayToProcess(0, 0, 0, choose.Below(2), "Given");
    }
    Run(drawing, field);
  }
}

vtkSmartPointer<vtkPolyData> FieldOf(vtkHarmonicFieldSolver* solver, vtkPolyData* input)
{
  auto field = vtkSmartPointer<vtkPolyData>::New();
  field->ShallowCopy(solver->GetOutput()->GetNumberOfCells() > 0 ? solver->GetOutput() : input);
  return field;
}

/// A line for most sides of the cells, some between points that share no cell, and a number for each.
vtkSmartPointer<vtkPolyData> EdgesOf(Choices& choose, vtkPolyData* surface)
{
  auto edges = vtkSmartPointer<vtkPolyData>::New();
  edges->SetPoints(surface->GetPoints());
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkIdList> corners;
  const int odd = choose.OneIn(3) ? 2 + choose.Below(20) : 1000000;
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    surface->GetCellPoints(cell, corners);
    for (vtkIdType k = 0; k < corners->GetNumberOfIds(); ++k)
    {
      const vtkIdType next = corners->GetId((k + 1) % corners->GetNumberOfIds());
      const vtkIdType other = choose.Below(static_cast<int>(surface->GetNumberOfPoints()));
      lines->InsertNextCell({ corners->GetId(k), choose.OneIn(odd) ? other : next });
    }
  }
  edges->SetLines(lines);
  vtkNew<vtkDoubleArray> form;
  form->SetName("OneForm");
  form->SetNumberOfTuples(lines->GetNumberOfCells());
  for (vtkIdType line = 0; line < lines->GetNumberOfCells(); ++line)
  {
    form->SetValue(line, odd < 1000000 ? choose.Number() : choose.Unit());
  }
  edges->GetCellData()->AddArray(form);
  return edges;
}

/// A flow given on edges instead of by vectors.
void RunWithEdges(Choices& choose, vtkHodgeDecomposition* hodge, vtkPolyData* surface)
{
  hodge->SetInputDataObject(1, EdgesOf(choose, surface));
  hodge->SetEdgeArray(choose.OneIn(12) ? "Given" : "OneForm");
  hodge->SetEdgeValues(choose.Below(2));
  Run(hodge, surface);
}

/// Distances from anything to anything.
void SetSources(Choices& choose, vtkSurfaceDistance* distance)
{
  distance->SetBoundary(choose.OneIn(4));
  distance->SetSharpEdges(choose.OneIn(4));
  distance->SetFeatureAngle(1.0 + 100.0 * choose.Unit());
  distance->SetAddPoint(choose.OneIn(2));
  distance->SetSigned(choose.OneIn(2));
  distance->SetMaximumDistance(choose.OneIn(4) ? choose.Unit() : 0.0);
  distance->SetMaximumSourceDistance(choose.OneIn(4) ? choose.Number() : 10.0);
  distance->SetNumberOfLevels(choose.Below(10));
  distance->SetCoordinates(choose.OneIn(8));
  distance->SetInputArrayToProcess(0, 0, 0, choose.Below(2), choose.OneIn(3) ? "Values" : "");
  distance->SetInputArrayToProcess(1, 0, 0, choose.Below(2), choose.OneIn(4) ? "Values" : "");
  if (choose.OneIn(2))
  {
    distance->SetPoint(choose.Number(), choose.Number(), choose.Number());
  }
  if (choose.OneIn(2))
  {
    const vtkSmartPointer<vtkPolyData> surface = SurfaceOf(choose);
    const auto sources = choose.OneIn(2) ? surface : EdgesOf(choose, surface);
    distance->AddInputDataObject(1, sources);
  }
  if (choose.OneIn(3))
  {
    distance->AddInputDataObject(2, SurfaceOf(choose));
  }
}

/// The triangles of a surface as strips, beside an array of any length.
vtkSmartPointer<vtkPolyData> StripsOf(Choices& choose, vtkPolyData* surface)
{
  auto strips = vtkSmartPointer<vtkPolyData>::New();
  strips->SetPoints(surface->GetPoints());
  strips->SetStrips(surface->GetPolys());
  const auto array = ArrayOf(choose, "Given", choose.Below(static_cast<int>(surface->GetNumberOfCells()) + 2), 3);
  strips->GetCellData()->AddArray(array);
  return strips;
}

/// Quads of a field or of a bare surface: each side of an edge has one quad at most, and the mesh has the Euler number of the surface.
void RunQuads(Choices& choose, vtkPolyData* surface)
{
  vtkNew<vtkFieldQuads> filter;
  filter->SetNumberOfQuads(1 + choose.Below(choose.OneIn(4) ? 2000 : 200));
  filter->SetEdgeLength(choose.OneIn(10) ? choose.Number() : 0.0);
  filter->SetNumberOfDirections(choose.Below(5));
  filter->SetAlignBoundary(choose.OneIn(2));
  filter->SetAlignSharpEdges(choose.OneIn(2));
  filter->SetFeatureAngle(180.0 * choose.Unit());
  filter->SetSmoothingSteps(choose.Below(8));
  filter->SetInputArrayToProcess(1, 0, 0, choose.Below(2), choose.OneIn(8) ? "Values" : "");
  Draw(choose, { filter }, surface);
  const auto numberOf = [&filter](const char* name)
  {
    vtkDataArray* const array = filter->GetOutput()->GetFieldData()->GetArray(name);
    return array ? array->GetComponent(0, 0) : 0.0;
  };
  if (numberOf("EulerCharacteristic") != numberOf("EulerCharacteristicOfSurface"))
  {
    throw std::runtime_error("the quads have another Euler characteristic than their surface");
  }
  std::set<std::pair<vtkIdType, vtkIdType>> sides;
  vtkNew<vtkIdList> corners;
  for (vtkIdType quad = 0; quad < filter->GetOutput()->GetNumberOfCells(); ++quad)
  {
    filter->GetOutput()->GetCellPoints(quad, corners);
    for (int k = 0; k < 4; ++k)
    {
      if (!sides.emplace(corners->GetId(k), corners->GetId((k + 1) % 4)).second)
      {
        throw std::runtime_error("two quads are on one side of an edge");
      }
    }
  }
}

/// Files for remeshers of a field that may be damaged: numbers that are finite, or an error and no file.
void RunWriter(Choices& choose, vtkDataSet* field, const std::filesystem::path& folder)
{
  const std::string file = (folder / "FuzzFilters.written").string();
  std::filesystem::remove(file);
  vtkNew<vtkFieldWriter> writer;
  const Messages messages(writer);
  writer->SetInputData(field);
  writer->SetFileName(file.c_str());
  writer->SetFormat(1 + choose.Below(3));
  writer->SetFeatureAngle(180.0 * choose.Unit());
  writer->Update(); // runs it: a writer has no output
  if (std::filesystem::exists(file) != messages.Error().empty())
  {
    throw std::runtime_error("vtkFieldWriter: neither a file nor an error, or both");
  }
  std::ifstream written(file);
  std::string word;
  while (std::getline(written, word))
  {
    if (word.find("nan") != std::string::npos || word.find("inf") != std::string::npos)
    {
      throw std::runtime_error("vtkFieldWriter: a number in the file is not finite");
    }
  }
}

/// What came to be read after the seeds of the corpus were found: choices of its own leave those cases as they are.
void RunOtherData(Choices choose, vtkPolyData* surface, const std::filesystem::path& folder)
{
  vtkNew<vtkHarmonicFieldSolver> solver; // the default kind of field
  solver->SetNumberOfDirections(1 + choose.Below(8));
  solver->SetBoundaryWeight(choose.Below(2));
  solver->SetSolver(choose.Below(6));
  solver->SetInputData(surface);
  if (choose.OneIn(2))
  {
    solver->SetInputArrayToProcess(1, 0, 0, choose.Below(2), "Given");
  }
  Run(solver, surface);
  vtkNew<vtkPolyData> field;
  field->DeepCopy(solver->GetOutput()->GetNumberOfCells() > 0 ? solver->GetOutput() : surface);
  if (choose.OneIn(2))
  {
    Damage(choose, field->GetCellData());
  }
  RunWriter(choose, field, folder);

  vtkNew<vtkFieldSingularities> singularities;
  vtkNew<vtkFieldLines> lines;
  vtkNew<vtkHodgeDecomposition> hodge;
  vtkNew<vtkParallelTransport> transport;
  vtkNew<vtkPrincipalDirections> principal;
  vtkNew<vtkFieldQuads> quads;
  quads->SetNumberOfQuads(1 + choose.Below(100));
  quads->SetSymmetry(choose.Below(3));
  for (int step = 1 + choose.Below(2); step > 0; --step) // the second time, much is kept
  {
    const vtkSmartPointer<vtkDataObject> data = choose.OneIn(2) ? VolumeOf(choose) : BlocksOf(choose, surface);
    for (vtkAlgorithm* const filter :
      std::initializer_list<vtkAlgorithm*>{ solver, singularities, lines, hodge, transport, principal, quads })
    {
      filter->SetInputDataObject(data);
      const Messages messages(filter);
      filter->Update(); // ends, with an output or an error
    }
    if (auto* const volume = vtkDataSet::SafeDownCast(data))
    {
      RunWriter(choose, volume, folder);
    }
  }
}

/// Draws of its own: what the seeds of the corpus draw stays.
void RunScales(Choices choose, vtkPolyData* surface)
{
  vtkNew<vtkScaleFilter> scales;
  scales->SetOrder(1 + choose.Below(2));
  scales->SetFlowKind(choose.Below(2));
  scales->SetPartsApart(choose.OneIn(2));
  scales->SetBoundary(choose.Below(2));
  scales->SetCoordinates(choose.OneIn(6) ? 1 : 0);
  scales->SetLengthScale(choose.OneIn(4) ? choose.Number() : 1.0);
  scales->SetSolver(choose.Below(3));
  scales->SetSpectrum(choose.OneIn(2));
  scales->SetSpectrumRows(1 + choose.Below(4));
  for (int k = choose.Below(3); k > 0; --k)
  {
    scales->AddWavelength(choose.OneIn(8) ? choose.Number() : 2.0 * choose.Unit());
  }
  for (const char* const name : { "Given", "Direction0", "SingularityIndex", "Values", "Weights" })
  {
    if (choose.OneIn(3))
    {
      scales->AddArray(name);
    }
  }
  if (choose.OneIn(4))
  {
    scales->SetInputArrayToProcess(1, 0, 0, choose.Below(2), "Weights");
    scales->SetInputArrayToProcess(2, 0, 0, choose.Below(2), "Weights");
  }
  Draw(choose, { scales }, surface);
}

/// The steps of a series: points and arrays that move, other surfaces, and nothing.
vtkSmartPointer<TimeSeries> SeriesOf(Choices& choose, vtkPolyData* surface)
{
  auto series = vtkSmartPointer<TimeSeries>::New();
  for (int steps = 2 + choose.Below(3); steps > 0; --steps)
  {
    vtkSmartPointer<vtkPolyData> step = choose.OneIn(4) ? SurfaceOf(choose) : vtkSmartPointer<vtkPolyData>::New();
    if (step->GetNumberOfCells() == 0 && !choose.OneIn(10))
    {
      step->DeepCopy(surface);
      if (choose.OneIn(2))
      {
        double place[3];
        const int point = choose.Below(static_cast<int>(step->GetNumberOfPoints()));
        step->GetPoint(point, place);
        place[choose.Below(3)] += 0.01 * choose.Number();
        step->GetPoints()->SetPoint(point, place);
      }
    }
    AddArrays(choose, step);
    series->Steps.push_back(step);
  }
  return series;
}

/// Filters at the times of a series, back and forth: what they give for a time depends on no other.
void RunSeries(Choices choose, vtkPolyData* surface)
{
  const vtkSmartPointer<TimeSeries> series = SeriesOf(choose, surface);
  vtkNew<vtkHarmonicFieldSolver> solver;
  solver->SetNumberOfDirections(1 + choose.Below(6));
  solver->SetBoundaryWeight(choose.Below(2));
  if (choose.OneIn(2))
  {
    solver->SetInputArrayToProcess(1, 0, 0, choose.Below(2), "Given");
  }
  vtkNew<vtkHodgeDecomposition> hodge;
  hodge->SetInputArrayToProcess(0, 0, 0, choose.Below(2), "Given");
  vtkNew<vtkParallelTransport> transport;
  vtkNew<vtkSurfaceDistance> distance;
  distance->SetInputArrayToProcess(0, 0, 0, choose.Below(2), choose.OneIn(2) ? "Values" : "");
  vtkNew<vtkScaleFilter> scales;
  scales->AddArray("Values");
  scales->AddWavelength(0.2 + choose.Unit());
  vtkNew<vtkFieldLines> lines;
  lines->SetSeparatingDistance(0.1);
  lines->SetInputArrayToProcess(0, 0, 0, choose.Below(2), "Given");
  for (vtkAlgorithm* const filter :
    std::initializer_list<vtkAlgorithm*>{ solver, hodge, transport, distance, scales, lines })
  {
    filter->SetInputConnection(series->GetOutputPort());
    std::map<int, std::map<std::string, std::string>> former;
    for (int visits = 5; visits > 0; --visits)
    {
      const int time = choose.Below(static_cast<int>(series->Steps.size()));
      const Messages messages(filter);
      filter->UpdateTimeStep(time);
      const auto bytes = BytesOf(filter->GetOutputDataObject(0));
      for (const auto& [name, numbers] : former.emplace(time, bytes).first->second)
      {
        const bool goesOn = filter == solver && name.find("Direction0") != std::string::npos; // SetCombing
        if (bytes.count(name) == 0 || (bytes.at(name) != numbers && !goesOn))
        {
          throw std::runtime_error(
            std::string(filter->GetClassName()) + ": the " + name + " is another when its time comes again");
        }
      }
      CheckNumbers(filter->GetOutputDataObject(0), series->Steps[time], false);
    }
  }
}

void RunCase(unsigned long long seed, const std::filesystem::path& folder)
{
  Choices choose(seed);
  vtkSmartPointer<vtkPolyData> input = SurfaceOf(choose);
  AddArrays(choose, input);
  if (choose.OneIn(3))
  {
    input = WithOperators(choose, input);
  }
  vtkNew<vtkHarmonicFieldSolver> solver;
  SetOptions(choose, solver);
  solver->SetInputData(input);
  if (choose.OneIn(4))
  {
    const auto guide = SurfaceOf(choose);
    AddArrays(choose, guide);
    solver->SetInputData(1, guide);
    solver->SetGuideArrayToProcess(1, 1, 0, choose.Below(2), choose.OneIn(2) ? "Given" : "");
  }
  Run(solver, input);
  if (choose.OneIn(3)) // what is kept from a former run
  {
    SetOptions(choose, solver);
    Run(solver, input);
  }
  vtkNew<vtkFieldSingularities> singularities;
  vtkNew<vtkFieldLines> lines;
  lines->SetSeparatingDistance(0.05);
  Draw(choose, { singularities, lines }, FieldOf(solver, input));

  RunWithFeatures(choose, solver, input);
  vtkNew<vtkFieldGlyphs> glyphs;
  glyphs->SetSeparatingDistance(0.01 + 0.1 * choose.Unit());
  glyphs->SetPlacement(choose.Below(2));
  glyphs->SetSizing(choose.Below(3));
  glyphs->SetStyle(choose.Below(2));
  vtkNew<vtkFieldAngles> angles;
  angles->SetAxis(choose.Number(), choose.Number(), choose.Number());
  angles->SetInputArrayToProcess(1, 0, 0, choose.Below(2), choose.OneIn(3) ? "Given" : "");
  vtkNew<vtkPrincipalDirections> principal;
  principal->SetScale(choose.OneIn(8) ? 100.0 * choose.Unit() : 4.0 * choose.Unit());
  vtkNew<vtkHodgeDecomposition> hodge;
  hodge->SetBoundary(choose.Below(2));
  hodge->SetSolver(choose.Below(3));
  hodge->SetNumberOfContours(choose.Below(10));
  const vtkSmartPointer<vtkPolyData> field = FieldOf(solver, input);
  Draw(choose, { singularities, lines, glyphs, angles, principal, hodge }, field);
  vtkNew<vtkParallelTransport> transport;
  transport->SetPoint(choose.Number(), choose.Number(), choose.Number());
  transport->SetDirection(choose.Number(), choose.Number(), choose.Number());
  transport->SetAddPoint(choose.OneIn(2));
  transport->SetUsePoint(transport->GetAddPoint());
  transport->SetTextureSize(choose.OneIn(2) ? choose.Unit() : 0.0);
  transport->SetTimeStep(choose.OneIn(4) ? 100.0 * choose.Unit() : 4.0);
  Draw(choose, { transport }, field);
  vtkNew<vtkSurfaceDistance> distance;
  SetSources(choose, distance);
  distance->SetInputData(field);
  Run(distance, field);
  RunWithEdges(choose, hodge, field);
  if (choose.OneIn(3))
  {
    const vtkSmartPointer<vtkDataSet> damaged = choose.OneIn(2)
      ? vtkSmartPointer<vtkDataSet>(DamagedGrid(choose, input))
      : vtkSmartPointer<vtkDataSet>(StripsOf(choose, input));
    for (vtkAlgorithm* const filter :
      std::initializer_list<vtkAlgorithm*>{ solver, principal, hodge, transport, distance, lines })
    {
      filter->SetInputDataObject(damaged);
      const Messages messages(filter);
      filter->Update(); // ends, with an output or an error
    }
  }
  RunQuads(choose, choose.OneIn(2) ? field : input);
  RunScales(Choices(seed + 2000000000), field);
  RunOtherData(Choices(seed + 1000000000), input, folder);
  RunSeries(Choices(seed + 3000000000), input);
}

/// \return whether it is as it must be.
bool Try(unsigned long long seed, const std::filesystem::path& record)
{
  std::ofstream(record) << seed << '\n';
  const std::clock_t start = std::clock(); // of this process, whatever else the machine does
  try
  {
    RunCase(seed, record.parent_path());
  }
  catch (const std::exception& error)
  {
    std::cerr << "seed " << seed << ": " << error.what() << std::endl;
    return false;
  }
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  if (seconds > 60.0)
  {
    std::cerr << "seed " << seed << " took " << seconds << " s of the processor" << std::endl;
    return false;
  }
  return true;
}

}

int main(int argc, char** argv)
{
  unsigned long long seed = 1, cases = std::numeric_limits<unsigned long long>::max();
  double seconds = std::numeric_limits<double>::infinity();
  std::string corpus;
  for (int i = 1; i + 1 < argc; i += 2)
  {
    const std::string name = argv[i], value = argv[i + 1];
    if (name == "--cases")
    {
      cases = std::stoull(value);
    }
    else if (name == "--seconds")
    {
      seconds = std::stod(value);
    }
    else if (name == "--first")
    {
      seed = std::stoull(value);
    }
    else if (name == "--corpus")
    {
      corpus = value;
    }
  }

  const auto start = std::chrono::steady_clock::now();
  int failures = 0;
  unsigned long long tried = 0;
  std::ifstream seeds(corpus);
  const std::filesystem::path record = std::filesystem::path(argv[0]).replace_filename("FuzzFilters.seed");
  for (; tried < cases; ++tried)
  {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    if (passed.count() > seconds || (!corpus.empty() && !(seeds >> seed)))
    {
      break;
    }
    failures += !Try(seed, record);
    ++seed;
  }
  std::cout << tried << " cases, " << failures << " must not be" << std::endl;
  return failures == 0 ? 0 : 1;
}
