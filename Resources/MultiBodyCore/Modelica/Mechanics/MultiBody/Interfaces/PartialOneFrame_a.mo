within Modelica.Mechanics.MultiBody.Interfaces;
partial model PartialOneFrame_a "Component with frame_a"
  Interfaces.Frame_a frame_a "Frame fixed to the component"
    annotation (Placement(transformation(extent={{-116,-16},{-84,16}})));
protected
  outer Modelica.Mechanics.MultiBody.World world;
  annotation (Documentation(info="<html><p>Base class of components with one frame.</p></html>"));
end PartialOneFrame_a;
