#include "app/png.h"

#include <stdexcept>

#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkWindowToImageFilter.h>

namespace pintle {

void write_png(vtkRenderWindow* window, const std::filesystem::path& file) {
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  image->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(image->GetOutputPort());
  writer->SetFileName(file.c_str());
  writer->Write();
  if (writer->GetErrorCode() != 0) throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace pintle
