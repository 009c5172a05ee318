// The parts of a flow: Flow SURFACE.ply OUTPUT.txt

#include <vtkCellData.h>
#include <vtkDataObject.h>
#include <vtkDataSet.h>
#include <vtkDoubleArray.h>
#include <vtkHodgeDecomposition.h>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>

#include <fstream>

int main(int, char* argv[])
{
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(argv[1]);
  reader->Update();
  vtkPolyData* surface = reader->GetOutput();
  vtkNew<vtkDoubleArray> flow; // along two triangles only
  flow->SetName("Flow");
  flow->SetNumberOfComponents(3);
  flow->SetNumberOfTuples(surface->GetNumberOfCells());
  flow->Fill(0.0);
  flow->SetTuple3(0, 1.0, 0.0, 0.0);
  flow->SetTuple3(1000, 1.0, 1.0, 1.0);
  surface->GetCellData()->AddArray(flow);

  vtkNew<vtkHodgeDecomposition> hodge;
  hodge->SetInputData(surface);
  hodge->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Flow");
  hodge->Update();

  vtkCellData* parts = vtkDataSet::SafeDownCast(hodge->GetOutputDataObject(0))->GetCellData();
  vtkDataArray* gradient = parts->GetArray("GradientPart"); // null after an error
  vtkDataArray* rotational = parts->GetArray("RotationalPart");
  std::ofstream file(argv[2]);
  file.precision(17);
  for (vtkIdType face = 0; gradient && face < gradient->GetNumberOfTuples(); ++face)
    for (vtkDataArray* part : { gradient, rotational })
      file << part->GetComponent(face, 0) << ' ' << part->GetComponent(face, 1) << ' ' << part->GetComponent(face, 2)
           << (part == gradient ? ' ' : '\n');
  return gradient ? 0 : 1;
}
