#include "vtkFieldWriter.h"

#include "Adapters/Output/FieldFiles.h"
#include "Adapters/Pipeline/PanelWords.h"
#include "Adapters/Pipeline/PropertyTable.h"
#include "Support/Errors.h"

#include "vtkDataSet.h"
#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtksys/SystemTools.hxx"

#include <filesystem>
#include <fstream>
#include <system_error>

vtkStandardNewMacro(vtkFieldWriter);

namespace
{

int FormatOf(const std::string& fileName)
{
  const std::string extension = vtksys::SystemTools::LowerCase(vtksys::SystemTools::GetFilenameLastExtension(fileName));
  for (const auto& [name, format] : { std::pair(".rosy", vtkFieldWriter::Rosy),
         std::pair(".rawfield", vtkFieldWriter::RawField), std::pair(".sharp", vtkFieldWriter::Sharp) })
  {
    if (extension == name)
    {
      return format;
    }
  }
  throw dmg::InvalidInput(
    "no format has the extension of '" + fileName + "'; give the file the extension .rosy, .rawfield or .sharp");
}

/// Writes beside a file and takes its place in the end, so that a full disk leaves the file as it was.
void WriteText(const std::string& fileName, const std::string& text)
{
  namespace files = std::filesystem;
  std::error_code ignored;
  const files::path given = files::u8path(fileName);
  const files::path path = files::is_symlink(given, ignored) ? files::canonical(given, ignored) : given;
  const bool isDevice = files::exists(path, ignored) && !files::is_regular_file(path, ignored);
  const files::path beside = isDevice ? path : files::path(path) += ".part";
  std::ofstream file(beside, std::ios::out | std::ios::binary);
  file << text;
  file.close();
  std::error_code error;
  if (file && !isDevice)
  {
    files::rename(beside, path, error);
  }
  if (!file || error)
  {
    if (!isDevice)
    {
      files::remove(beside, ignored);
    }
    throw dmg::InvalidInput(
      "the file '" + fileName + "' cannot be written; choose a folder where you may, with room left");
  }
}

}

//------------------------------------------------------------------------------
int vtkFieldWriter::FillInputPortInformation(int, vtkInformation* information)
{
  information->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  return 1;
}

//------------------------------------------------------------------------------
dmg::PropertyTable vtkFieldWriter::Properties() const
{
  dmg::PropertyTable table;
  table.Text("FileName", this->FileName);
  table.Choice("Format", this->Format, { "ByExtension", "Rosy", "RawField", "Sharp" });
  table.Number("FeatureAngle", this->FeatureAngle, 0, 180);
  return table;
}

//------------------------------------------------------------------------------
void vtkFieldWriter::WriteData()
{
  try
  {
    this->Properties().Check();
    auto* const surface = vtkDataSet::SafeDownCast(this->GetInput());
    const int format = this->Format == ByExtension ? FormatOf(this->FileName) : this->Format;
    WriteText(this->FileName,
      format == Rosy         ? dmg::RosyFileOf(surface)
        : format == RawField ? dmg::RawFieldFileOf(surface)
                             : dmg::SharpFileOf(surface, this->FeatureAngle));
    if (const std::string warning = format == Sharp ? "" : dmg::WarningOfPolygons(surface); !warning.empty())
    {
      vtkWarningMacro(<< warning);
    }
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< dmg::InPanelWords(error.what()));
    this->SetErrorCode(vtkErrorCode::CannotOpenFileError);
  }
}

//------------------------------------------------------------------------------
void vtkFieldWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->Properties().Print(os, indent);
}
