// A cross field on a sphere: CrossField OUTPUT.vtp

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkHarmonicFieldSolver.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSphereSource.h>
#include <vtkXMLPolyDataWriter.h>

#include <cstdlib>

int main(int argc, char* argv[])
{
  if (argc != 2)
  {
    return EXIT_FAILURE;
  }

  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(60);
  sphere->SetPhiResolution(60);
  sphere->Update();
  vtkPolyData* surface = sphere->GetOutput();

  // A direction at one face, zero (not prescribed) elsewhere.
  vtkNew<vtkDoubleArray> directions;
  directions->SetName("Directions");
  directions->SetNumberOfComponents(3);
  directions->SetNumberOfTuples(surface->GetNumberOfCells());
  directions->Fill(0.0);
  directions->SetTuple3(1000, 1.0, 0.0, 0.0);
  surface->GetCellData()->AddArray(directions);

  vtkNew<vtkHarmonicFieldSolver> solver;
  solver->SetInputData(surface);
  solver->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Directions");
  solver->SetNumberOfDirections(4);

  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputConnection(solver->GetOutputPort());
  writer->SetFileName(argv[1]);
  writer->SetDataModeToBinary(); // see README, "Files"
  return writer->Write() ? EXIT_SUCCESS : EXIT_FAILURE;
}
