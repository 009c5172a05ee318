// Crosses that follow two directions: CrossField SURFACE.ply OUTPUT.txt

#include <vtkCellData.h>
#include <vtkDataObject.h>
#include <vtkDoubleArray.h>
#include <vtkHarmonicFieldSolver.h>
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
  vtkNew<vtkDoubleArray> directions; // zero where nothing is prescribed
  directions->SetName("Directions");
  directions->SetNumberOfComponents(3);
  directions->SetNumberOfTuples(surface->GetNumberOfCells());
  directions->Fill(0.0);
  directions->SetTuple3(0, 1.0, 0.0, 0.0);
  directions->SetTuple3(1000, 1.0, 1.0, 1.0);
  surface->GetCellData()->AddArray(directions);

  vtkNew<vtkHarmonicFieldSolver> solver;
  solver->SetInputData(surface);
  solver->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Directions");
  solver->SetNumberOfDirections(4);
  solver->SetTolerance(1e-10);
  solver->Update();

  vtkDataArray* field = solver->GetOutput()->GetCellData()->GetArray("Direction0"); // null after an error
  std::ofstream file(argv[2]);
  file.precision(17);
  for (vtkIdType face = 0; field && face < field->GetNumberOfTuples(); ++face)
    file << field->GetComponent(face, 0) << ' ' << field->GetComponent(face, 1) << ' ' << field->GetComponent(face, 2)
         << '\n';
  return field ? 0 : 1;
}
