/**
 * @class   vtkFieldGlyphs
 * @brief   arrows, lines, crosses and stars of a field of N directions on a surface
 *
 * vtkFieldGlyphs draws a field of N directions by glyphs on the surface: an arrow for N = 1, a line for N = 2, a cross
 * for N = 4, and a star of N branches for every other N. They are spread evenly, at a distance of the user's choice,
 * or stand on every triangle.
 *
 * A glyph is laid onto the surface: its branches go straight on over the triangles and bend with them, and end at the
 * boundary. So even large ones on strongly curved places neither stick out nor sink in.
 *
 * Evenly spread places are Poisson-disc samples (R. L. Cook, "Stochastic sampling in computer graphics", 1986): none is
 * nearer to another one than the distance, measured over the surface, and hardly a place is farther than that from all
 * of them. They do not depend on the field: those of two fields on one surface stand at the same places.
 *
 * @section vtkFieldGlyphs-Output Output
 *
 * Port 0: vtkPolyData, polygons (Solid) or polylines (Strokes), several per branch and glyph.
 *
 * | array     | of     | components | type   | meaning                                                    |
 * | --------- | ------ | ---------- | ------ | ---------------------------------------------------------- |
 * | Branch    | cells  | 1          | int    | family, the same for opposite directions                   |
 * | Direction | cells  | 1          | int    | 0 for the direction of the chosen array, 1 for the next one, ... N - 1 |
 * | Glyph     | cells  | 1          | int    | number of the place                                        |
 * | Magnitude | cells  | 1          | double | of the field in the triangle at the centre                 |
 * | Normals   | points | 3          | float  | of the surface; the active normals                         |
 *
 * Normals are unit vectors, and half as long at thin walls, as of vtkFieldLines.
 *
 * @section vtkFieldGlyphs-Execution Execution
 *
 * The time is linear in the triangles and in the number of glyphs, of which more than a million are an error.
 *
 * @sa vtkFieldLines vtkFieldSingularities vtkHarmonicFieldSolver
 */

#ifndef vtkFieldGlyphs_h
#define vtkFieldGlyphs_h

#include "vtkFieldDrawingAlgorithm.h"
#include "vtkFiltersDirectionalFieldsModule.h" // For export macro

namespace dmg
{
class PropertyTable;
}

class VTKFILTERSDIRECTIONALFIELDS_EXPORT vtkFieldGlyphs : public vtkFieldDrawingAlgorithm
{
public:
  static vtkFieldGlyphs* New();
  vtkTypeMacro(vtkFieldGlyphs, vtkFieldDrawingAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Placements
  {
    /** At SeparatingDistance from each other. */
    EvenlySpread = 0,
    /** A glyph in the centre of each triangle. */
    EveryTriangle = 1
  };

  ///@{
  /**
   * The places of glyphs, one of Placements. Default EvenlySpread.
   */
  vtkSetMacro(Placement, int);
  vtkGetMacro(Placement, int);
  ///@}

  ///@{
  /**
   * Distance between glyphs that are evenly spread, as a fraction of the surface's size, the diagonal of the box around
   * its triangles. Default 0.02, range 0.0005 to 1.
   */
  vtkSetMacro(SeparatingDistance, double);
  vtkGetMacro(SeparatingDistance, double);
  ///@}

  enum Sizings
  {
    /** All alike: half the distance between glyphs; on every triangle, the mean size of the triangles. */
    Even = 0,
    /** The size of the triangle at the centre. */
    ByTriangle = 1,
    /** The size of Even where the field is largest, elsewhere in proportion to its magnitude. */
    ByMagnitude = 2
  };

  ///@{
  /**
   * The length of branches, one of Sizings. Default Even.
   */
  vtkSetMacro(Sizing, int);
  vtkGetMacro(Sizing, int);
  ///@}

  ///@{
  /**
   * A factor of all lengths. Default 0.9, range 0.01 to 100.
   */
  vtkSetMacro(ScaleFactor, double);
  vtkGetMacro(ScaleFactor, double);
  ///@}

  enum Styles
  {
    /** Polygons: wide branches, which grow with the picture. */
    Solid = 0,
    /** Polylines: as wide on the screen as the line width says. */
    Strokes = 1
  };

  ///@{
  /**
   * The cells of glyphs, one of Styles. Default Solid.
   */
  vtkSetMacro(Style, int);
  vtkGetMacro(Style, int);
  ///@}

  ///@{
  /**
   * Half the width of a solid branch over its length. Default 0.1, range 0.005 to 0.3.
   */
  vtkSetMacro(Width, double);
  vtkGetMacro(Width, double);
  ///@}

  ///@{
  /**
   * The distance of glyphs from the surface along its normal, as a fraction of the surface's size. Default 0, range 0 to 0.1: they
   * lie in the surface, and show from both sides of it where they are drawn nearer to the viewer, as ParaView does in the representation
   * Ink; for other programs, see GetInkShader(). Elsewhere a thousandth shows them from one side.
   */
  vtkSetMacro(Lift, double);
  vtkGetMacro(Lift, double);
  ///@}

  vtkFieldGlyphs(const vtkFieldGlyphs&) = delete;
  void operator=(const vtkFieldGlyphs&) = delete;

protected:
  vtkFieldGlyphs() = default;
  ~vtkFieldGlyphs() override = default;

  int RequestData(
    vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector) override;

private:
  dmg::PropertyTable Properties() const;

  int Placement = EvenlySpread;
  double SeparatingDistance = 0.02;
  int Sizing = Even;
  double ScaleFactor = 0.9;
  int Style = Solid;
  double Width = 0.1;
  double Lift = 0.0;
};

#endif
