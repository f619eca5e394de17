#include "framework/component/fe_model.h"
