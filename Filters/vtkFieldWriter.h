/**
 * @class   vtkFieldWriter
 * @brief   writes a field for remeshers
 *
 * The input is a surface with a field, as vtkHarmonicFieldSolver leaves it: any vtkDataSet whose cells of two dimensions have the array
 * Direction0. Files number faces as these cells, so that the surface goes along in a file that keeps their order, as PLY or OBJ.
 *
 * | extension | contents                                                                                                  |
 * | --------- | --------------------------------------------------------------------------------------------------------- |
 * | .rosy     | the number of faces, the number N of directions, a unit vector of each face; quadwild and programs on vcglib take N = 4 |
 * | .rawfield | N, the number of faces, the N vectors of each face, counter-clockwise; Directional's read_raw_field()      |
 * | .sharp    | boundary and sharp edges of triangles, for quadwild; it needs no field. The number of lines, then "kind,face,side" for each edge: kind 0 is concave, side j goes from corner j to the next; an edge of more than two faces has a line for each |
 *
 * Errors leave no file: a face without a direction (.rosy), one that is no triangle (.sharp), directions that are not finite. A face that is
 * no triangle is a warning for .rosy and .rawfield, whose readers take triangles alone.
 *
 * @sa vtkHarmonicFieldSolver vtkFieldQuads
 */

#ifndef vtkFieldWriter_h
#define vtkFieldWriter_h

#include "vtkFiltersDirectionalFieldsModule.h" // For export macro
#include "vtkWriter.h"

#include <string> // For std::string

namespace dmg
{
class PropertyTable;
}

class VTKFILTERSDIRECTIONALFIELDS_EXPORT vtkFieldWriter : public vtkWriter
{
public:
  static vtkFieldWriter* New();
  vtkTypeMacro(vtkFieldWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The name of the file. Default empty, which is an error.
   */
  vtkSetStdStringFromCharMacro(FileName);
  vtkGetCharFromStdStringMacro(FileName);
  ///@}

  enum Formats
  {
    /** The extension of FileName says it; another one is an error. */
    ByExtension = 0,
    Rosy = 1,
    RawField = 2,
    Sharp = 3
  };

  ///@{
  /**
   * The format of the file, one of Formats. Default ByExtension.
   */
  vtkSetMacro(Format, int);
  vtkGetMacro(Format, int);
  ///@}

  ///@{
  /**
   * The angle between the normals of two triangles in degrees, from which on their edge is sharp (Sharp alone). Default 30, range 0 to 180.
   */
  vtkSetMacro(FeatureAngle, double);
  vtkGetMacro(FeatureAngle, double);
  ///@}

  vtkFieldWriter(const vtkFieldWriter&) = delete;
  void operator=(const vtkFieldWriter&) = delete;

protected:
  vtkFieldWriter() = default;
  ~vtkFieldWriter() override = default;

  int FillInputPortInformation(int port, vtkInformation* information) override;
  void WriteData() override;

private:
  dmg::PropertyTable Properties() const;

  std::string FileName;
  int Format = ByExtension;
  double FeatureAngle = 30.0;
};

#endif
