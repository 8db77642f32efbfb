within Modelica.Mechanics.MultiBody.Interfaces;
partial model PartialOneFrame_b "Component with frame_b"
  Interfaces.Frame_b frame_b "Frame fixed to the component"
    annotation (Placement(transformation(extent={{84,-16},{116,16}})));
protected
  outer Modelica.Mechanics.MultiBody.World world;
  annotation (Documentation(info="<html><p>Base class of components with one frame.</p></html>"));
end PartialOneFrame_b;
