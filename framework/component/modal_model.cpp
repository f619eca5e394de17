#include "framework/component/modal_model.h"
