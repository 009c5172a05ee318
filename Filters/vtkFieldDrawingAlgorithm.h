/**
 * @class   vtkFieldDrawingAlgorithm
 * @brief   base class of filters that read a field of N directions on a surface
 *
 * @section vtkFieldDrawingAlgorithm-Inputs Inputs
 *
 * Port 0: a surface as vtkOrientedSurfaceAlgorithm describes it, with the field as vectors on cells or points. The tangential
 * part of a vector counts, on cells that without the part along the normal of its cell; its length is the magnitude of the field, and where it is zero there is no direction. The array is
 * chosen by
 *
 *   SetInputArrayToProcess(0, 0, 0, association, name).
 *
 * The default is Direction0 of the cells, or of the points, or else the active vectors of the cells, or of the
 * points. Where cells and points have an array Direction0, as vtkHarmonicFieldSolver leaves them, that of the cells is taken for
 * both: the other one is its mean. The array holds one direction of N; the others are those, turned by 2 pi / N. Vectors at
 * points are averaged over the corners of each triangle, as N-th powers. The direction of a tensor of 6 (XX YY ZZ XY YZ XZ) or 9
 * components is that of the largest eigenvalue in the tangent plane, with N = 2 by default. In a plane of constant z, vectors may
 * have 2 components. Those that are not finite are no directions, and a warning counts them. Fill values are an error or a warning, as
 * of vtkHodgeDecomposition. Vectors that flip from element to
 * element, as eigenvectors do, are a warning where N is 1: they have no sign.
 *
 * @section vtkFieldDrawingAlgorithm-Execution Execution
 *
 * Threads, errors, aborts and pieces are those of vtkOrientedSurfaceAlgorithm.
 *
 * @sa vtkFieldLines vtkFieldGlyphs vtkFieldSingularities vtkFieldQuads
 */

#ifndef vtkFieldDrawingAlgorithm_h
#define vtkFieldDrawingAlgorithm_h

#include "vtkFiltersDirectionalFieldsModule.h" // For export macro
#include "vtkPolyDataAlgorithm.h"

class VTKFILTERSDIRECTIONALFIELDS_EXPORT vtkFieldDrawingAlgorithm : public vtkPolyDataAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkFieldDrawingAlgorithm, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * N, the number of directions per point of which the chosen array holds one. 0, the default: as many as the solver had, or as there are
   * arrays Direction0, Direction1, ..., if Direction0 is chosen, 2 for the arrays of vtkPrincipalDirections, whose names tell, and 1 for
   * any other array. Range 0 to 8.
   */
  vtkSetMacro(NumberOfDirections, int);
  vtkGetMacro(NumberOfDirections, int);
  ///@}

  /**
   * A part of the vertex shader that draws an actor nearer to the viewer, by two thousandths of its distance, as ParaView's representation
   * Ink does. Lines, glyphs and contours that lie in a surface then show from both sides of it, whatever mapper the actor has:
   *
   *   actor->GetShaderProperty()->AddVertexShaderReplacement(
   *     "//VTK::PositionVC::Impl", true, vtkFieldDrawingAlgorithm::GetInkShader(), false);
   *
   * Without light it has the same colour on both sides, by
   *
   *   actor->GetShaderProperty()->AddFragmentShaderReplacement(
   *     "//VTK::Light::Impl", true, "gl_FragData[0] = vec4(ambientColor + diffuseColor, opacity);\n", false);
   *
   * Lines and glyphs whose normals are half as long, as those of thin walls, are drawn farther from the viewer instead where they face away,
   * so that they show from their own side alone. With vtkProperty::LightingOff VTK takes no normals, and all show from both sides.
   * In Python, directionalmultigrid.draw_as_ink(actor) does so.
   */
  static const char* GetInkShader();

  vtkFieldDrawingAlgorithm(const vtkFieldDrawingAlgorithm&) = delete;
  void operator=(const vtkFieldDrawingAlgorithm&) = delete;

protected:
  vtkFieldDrawingAlgorithm() = default;
  ~vtkFieldDrawingAlgorithm() override = default;

  int FillInputPortInformation(int port, vtkInformation* information) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector) override;

  int NumberOfDirections = 0;
};

#endif
