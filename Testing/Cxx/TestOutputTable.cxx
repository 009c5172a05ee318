#include "Adapters/Surface/OutputTable.h"

#include "vtkFieldAngles.h"
#include "vtkFieldGlyphs.h"
#include "vtkFieldLines.h"
#include "vtkFieldQuads.h"
#include "vtkFieldSingularities.h"
#include "vtkHodgeDecomposition.h"
#include "vtkParallelTransport.h"
#include "vtkPrincipalDirections.h"
#include "vtkScaleFilter.h"
#include "vtkSurfaceDistance.h"

#include "SolverTools.h"
#include "TestTools.h"

#include "vtkExtractEdges.h"
#include "vtkLineSource.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace
{

using namespace dmg::test;
using dmg::OutputArray;
using dmg::OutputTable;

// What the manual says
// ------------------------------------------------------------------------------------------

std::string TextOf(const std::filesystem::path& path)
{
  std::ifstream file(path);
  return { std::istreambuf_iterator<char>(file), {} };
}

const std::filesystem::path Manual = DMG_FILTERS;

/// A row of a table: what stands in its cells, by the words above them.
using ManualRow = std::map<std::string, std::string>;

std::vector<std::string> CellsOf(const std::string& line)
{
  std::vector<std::string> cells;
  std::istringstream parts(line.substr(line.find('|') + 1));
  for (std::string cell; std::getline(parts, cell, '|');)
  {
    cells.push_back(std::regex_replace(cell, std::regex("^ +| +$"), ""));
  }
  return cells;
}

/// The rows of all tables of arrays of a text, with the port they are told for.
std::vector<ManualRow> RowsOf(const std::string& text)
{
  std::vector<ManualRow> rows;
  std::vector<std::string> heads;
  std::string port = "0";
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
  {
    std::smatch match;
    if (std::regex_search(line, match, std::regex("^ \\* Port (\\d)")))
    {
      port = match[1];
    }
    if (!std::regex_search(line, std::regex("^( \\* )?\\|")))
    {
      heads.clear();
      continue;
    }
    const std::vector<std::string> cells = CellsOf(line);
    if (heads.empty())
    {
      heads = cells;
      continue;
    }
    const bool isOfHeader = line.compare(0, 2, " *") == 0;
    const bool isOfArrays = heads[0] == "array" || heads[0] == "field array" || heads[0] == "column";
    if (isOfArrays && cells[0].find("---") == std::string::npos)
    {
      rows.push_back({ { "port",
        heads[0] == "column" && !isOfHeader ? "2"
          : heads[0] == "field array"       ? "0"
                                            : port } });
      for (std::size_t k = 0; k < cells.size(); ++k)
      {
        rows.back()[heads[k]] = cells[k];
      }
    }
  }
  return rows;
}

unsigned PlacesOf(const ManualRow& row)
{
  if (row.count("column") > 0)
  {
    return OutputArray::Columns;
  }
  const bool isOfData = row.count("tuples") > 0 || row.count("field array") > 0;
  const std::string of = row.count("of") > 0 ? row.at("of") : isOfData ? "field" : "cells, points";
  unsigned places = 0;
  const std::pair<const char*, unsigned> words[] = { { "cells", OutputArray::Cells }, { "points", OutputArray::Points },
    { "field", OutputArray::FieldData } };
  for (const auto& [word, place] : words)
  {
    places |= of.find(word) == std::string::npos ? 0U : place;
  }
  return places;
}

/// The names of a row, such as "Divergence, Vorticity", or "HarmonicBasis 1, 2, ... k".
std::vector<std::string> NamesOf(const ManualRow& row)
{
  const auto first = row.count("array") > 0 ? row.find("array")
    : row.count("column") > 0               ? row.find("column")
                                            : row.find("field array");
  std::vector<std::string> names;
  std::istringstream parts(std::regex_replace(first->second, std::regex(", "), ","));
  for (std::string name; std::getline(parts, name, ',');)
  {
    if (std::regex_match(name, std::regex("[A-Z]\\w*( \\d)?")))
    {
      names.push_back(name);
    }
  }
  return names;
}

/// The header of a filter, and the page on its details if there is one.
std::string ManualOf(const std::string& filter)
{
  return TextOf(Manual / (filter + ".h")) + TextOf(Manual / (filter.substr(3) + ".md"));
}

const OutputArray* Find(const std::string& filter, int port, const std::string& name, unsigned places)
{
  for (const OutputArray& row : OutputTable())
  {
    const bool isOfFilter = row.Filter == filter || row.Filter == std::string("vtkOrientedSurfaceAlgorithm");
    if (isOfFilter && row.Port == port && row.IsNamed(name) && (row.Places & places) == places)
    {
      return &row;
    }
  }
  return nullptr;
}

bool IsAnyNumber(const OutputArray& row)
{
  return row.Components == std::numeric_limits<int>::max();
}

/// Whether a filter names an array after one of the input's, as in "height below 3".
bool IsNamedAfterInput(const std::string& filter, const std::string& name)
{
  return filter == "vtkScaleFilter" && name.find(' ') != std::string::npos;
}

TEST(OutputTable, HoldsEachArrayOfTheManualsTables)
{
  int rows = 0;
  for (const auto& file : std::filesystem::directory_iterator(Manual))
  {
    const std::string filter = file.path().stem().string();
    if (file.path().extension() != ".h" || filter == "vtkDirectionalProlongation") // whose names have parts
    {
      continue;
    }
    for (const ManualRow& row : RowsOf(ManualOf(filter)))
    {
      ++rows;
      for (const std::string& name : NamesOf(row))
      {
        const OutputArray* const found = Find(filter, std::stoi(row.at("port")), name, PlacesOf(row));
        ASSERT_TRUE(found) << filter << ": " << name;
        EXPECT_EQ(found->Places, PlacesOf(row)) << filter << ": " << name;
        EXPECT_TRUE(IsAnyNumber(*found) ||
          std::to_string(found->Components) == (row.count("components") ? row.at("components") : "1"))
          << filter << ": " << name;
      }
    }
  }
  EXPECT_GT(rows, 70);
}

TEST(OutputTable, IsToldInTheManual)
{
  for (const OutputArray& row : OutputTable())
  {
    const std::string name = std::regex_replace(std::string(row.Name), std::regex(" $"), "");
    EXPECT_TRUE(std::regex_search(ManualOf(row.Filter), std::regex("\\b" + name)))
      << row.Filter << " does not tell " << name;
  }
}

// What the filters write
// ------------------------------------------------------------------------------------------

/// The rows of the arrays that filters have written.
std::set<const OutputArray*>& Seen()
{
  static std::set<const OutputArray*> seen;
  return seen;
}

void SeeArrays(const std::string& filter, int port, vtkFieldData* given, vtkFieldData* data, unsigned place)
{
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* const array = data->GetAbstractArray(i);
    const std::string name = array->GetName();
    if ((given && given->GetAbstractArray(name.c_str())) || IsNamedAfterInput(filter, name))
    {
      continue;
    }
    const OutputArray* const row = Find(filter, port, name, place);
    EXPECT_TRUE(row) << filter << " writes " << name << " on port " << port;
    if (row)
    {
      EXPECT_TRUE(IsAnyNumber(*row) || array->GetNumberOfComponents() == row->Components) << filter << ": " << name;
      Seen().insert(row);
    }
  }
}

/// Runs a filter: all that it writes is in the table, and can be taken away.
void RunFilter(vtkAlgorithm* filter, vtkPolyData* input)
{
  const std::string name = filter->GetClassName();
  Messages messages(filter);
  filter->SetInputDataObject(input);
  filter->Update();
  EXPECT_EQ(messages.Error(), "");
  for (int port = 0; port < filter->GetNumberOfOutputPorts(); ++port)
  {
    if (auto* const table = vtkTable::SafeDownCast(filter->GetOutputDataObject(port)))
    {
      SeeArrays(name, port, nullptr, table->GetRowData(), OutputArray::Columns);
      continue;
    }
    auto* const output = vtkDataSet::SafeDownCast(filter->GetOutputDataObject(port));
    // Arrows are the output of another filter, and the map and the spheres have the arrays of what they show.
    const bool isOfOthers =
      (name == "vtkParallelTransport" && port == 1) || (name == "vtkFieldSingularities" && port == 3);
    if (!isOfOthers)
    {
      const bool isMadeOfIndices = name == "vtkFieldQuads" && port == 2;
      vtkNew<vtkPolyData> known;
      known->ShallowCopy(input);
      if (isMadeOfIndices)
      {
        for (const char* const other : { "Index", "Normals" }) // of balls
        {
          known->GetPointData()->AddArray(Zeros(other, input->GetNumberOfPoints(), 1));
        }
      }
      SeeArrays(name, port, known->GetPointData(), output->GetPointData(), OutputArray::Points);
      SeeArrays(name, port, known->GetCellData(), output->GetCellData(), OutputArray::Cells);
      SeeArrays(name, port, known->GetFieldData(), output->GetFieldData(), OutputArray::FieldData);
    }
  }
  vtkNew<vtkPolyData> output;
  output->ShallowCopy(filter->GetOutputDataObject(0));
  if (output->GetNumberOfPoints() == input->GetNumberOfPoints() && name != "vtkScaleFilter") // it is the surface
  {
    dmg::RemoveOutputs(name, output);
    EXPECT_EQ(output->GetPointData()->GetNumberOfArrays(), input->GetPointData()->GetNumberOfArrays()) << name;
    EXPECT_EQ(output->GetCellData()->GetNumberOfArrays(), input->GetCellData()->GetNumberOfArrays()) << name;
  }
}

vtkSmartPointer<vtkPolyData> RunSolver(vtkPolyData* input, int discretisation)
{
  const auto solver = NewSolver(input, discretisation);
  solver->HarmonicBasisOn();
  if (!input->GetCellData()->HasArray("Given"))
  {
    solver->SetInputArrayToProcess(1, 0, 0, OnCells, "");
  }
  RunFilter(solver, input);
  auto output = vtkSmartPointer<vtkPolyData>::New();
  output->ShallowCopy(solver->GetOutputDataObject(0));
  return output;
}

void RunFields()
{
  const auto torus = PolyDataOf(Torus(24, 12));
  AddCellVectors(torus, "Given", { { 10, { 1.0, 0.5, -0.25 } }, { 200, { -0.5, 0.25, 1.0 } } });
  for (const int kind : { Solver::PowerField, Solver::FaceField, Solver::OneForm, Solver::PointPowerField })
  {
    RunSolver(torus, kind);
  }
  const auto sphere = Sphere(2);
  AddPointVectors(sphere, "Vectors", {});
  const auto values = Zeros("Heights", sphere->GetNumberOfPoints(), 1);
  values->SetValue(3, 1.0);
  sphere->GetPointData()->AddArray(values);
  const auto function = NewSolver(sphere, Solver::ScalarFunction);
  function->SetInputArrayToProcess(1, 0, 0, OnCells, "");
  function->SetInputArrayToProcess(3, 0, 0, OnPoints, "Heights");
  RunFilter(function, sphere);
  const auto guided = NewSolver(sphere);
  vtkNew<vtkLineSource> guide;
  guide->SetPoint1(1.0, 0.1, 0.1);
  guide->SetPoint2(0.9, 0.3, 0.2);
  guided->AddGuidesConnection(guide->GetOutputPort());
  RunFilter(guided, sphere);
  const auto withTensors = Sphere(2);
  withTensors->GetCellData()->AddArray(Zeros("Tensors", withTensors->GetNumberOfCells(), 6));
  withTensors->GetCellData()->GetArray("Tensors")->FillComponent(0, 1.0);
  const auto alongTensors = NewSolver(withTensors);
  alongTensors->SetNumberOfDirections(2);
  alongTensors->SetInputArrayToProcess(1, 0, 0, OnCells, "Tensors");
  RunFilter(alongTensors, withTensors);
  const auto smoothest = NewSolver(sphere);
  smoothest->SetInputArrayToProcess(1, 0, 0, OnCells, "");
  RunFilter(smoothest, sphere);
}

void RunFlows()
{
  const auto ring = PolyDataOf(Annulus(24, 5));
  AddCellVectors(ring, "Flow", { { 3, { 1.0, 0.5, 0.25 } }, { 40, { -0.5, 0.25, 1.0 } } });
  vtkDataArray* const flow = ring->GetCellData()->GetArray("Flow");
  flow->SetComponent(100, 0, std::numeric_limits<double>::quiet_NaN());
  vtkNew<vtkHodgeDecomposition> decomposition;
  decomposition->SetInputArrayToProcess(0, 0, 0, OnCells, "Flow");
  decomposition->SteeringFlowOn();
  decomposition->SetNumberOfContours(5);
  RunFilter(decomposition, ring);

  const auto whole = PolyDataOf(Annulus(24, 5));
  vtkNew<vtkExtractEdges> edges;
  edges->SetInputData(whole);
  edges->Update();
  vtkNew<vtkPolyData> components;
  components->ShallowCopy(edges->GetOutput());
  components->GetCellData()->AddArray(Zeros("Components", components->GetNumberOfCells(), 1));
  components->GetCellData()->GetArray("Components")->SetComponent(7, 0, 1.0);
  vtkNew<vtkHodgeDecomposition> ofEdges;
  ofEdges->SetInputDataObject(1, components);
  ofEdges->SetEdgeArray("Components");
  ofEdges->SetEdgeValues(vtkHodgeDecomposition::Components);
  RunFilter(ofEdges, whole);
}

void RunOthers()
{
  const auto sphere = Sphere(2);
  vtkNew<vtkParallelTransport> transport;
  transport->SetNumberOfCircles(4);
  RunFilter(transport, sphere);
  const auto withLand = Sphere(2);
  withLand->GetCellData()->AddArray(Zeros("Land", withLand->GetNumberOfCells(), 1));
  withLand->GetCellData()->GetArray("Land")->SetComponent(7, 0, std::numeric_limits<double>::quiet_NaN());
  vtkNew<vtkLineSource> targets;
  targets->SetPoint1(0.0, 0.8, 0.6);
  targets->SetPoint2(0.6, 0.8, 0.0);
  vtkNew<vtkSurfaceDistance> distance;
  distance->SetInputArrayToProcess(1, 0, 0, OnCells, "Land");
  distance->AddTargetsConnection(targets->GetOutputPort());
  distance->SetNumberOfLevels(4);
  RunFilter(distance, withLand);
  vtkNew<vtkScaleFilter> scales;
  scales->AddArray("Land");
  scales->AddWavelength(0.5);
  RunFilter(scales, withLand);
  Surface withTurnedFace = Icosphere(2);
  std::swap(withTurnedFace.F(5, 0), withTurnedFace.F(5, 1));
  RunFilter(vtkNew<vtkPrincipalDirections>(), PolyDataOf(withTurnedFace));
  vtkNew<vtkFieldQuads> quads;
  quads->SetNumberOfQuads(300);
  quads->SetSymmetry(vtkFieldQuads::Automatic);
  quads->CutForTexturesOn();
  RunFilter(quads, sphere);
  for (const int kind : { Solver::PowerField, Solver::PointPowerField })
  {
    const auto field = RunSolver(PolyDataOf(IrregularSphere(2, 7)), kind);
    field->GetFieldData()->RemoveArray("PositiveSide"); // so that angles write it
    RunFilter(vtkNew<vtkFieldAngles>(), field);
    RunFilter(vtkNew<vtkFieldLines>(), field);
    RunFilter(vtkNew<vtkFieldGlyphs>(), field);
    RunFilter(vtkNew<vtkFieldSingularities>(), field);
  }
  const auto bounded = RunSolver(PolyDataOf(Disk(6)), Solver::PowerField);
  RunFilter(vtkNew<vtkFieldSingularities>(), bounded);
}

TEST(OutputTable, HoldsAllArraysThatFiltersWriteAndNoOthers)
{
  RunFields();
  RunFlows();
  RunOthers();
  for (const OutputArray& row : OutputTable())
  {
    EXPECT_EQ(Seen().count(&row), 1U) << row.Filter << " writes no " << row.Name << " on port " << row.Port;
  }
}

}
